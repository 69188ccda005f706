// SPDX-License-Identifier: LGPL-2.1-or-later
#include "point_fields.h"

#include <myolines/measures/acoustic_tensor.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace myolines
{
  namespace
  {
    struct ScalarField
    {
      std::string                                                                               name, unit;
      std::function<double(const Muscle3dParameters &, const Activation &, const PointState &)> value;
    };

    Matrix3 cauchy(const Matrix3 &P, const PointState &p) { return P * transpose(p.F) / p.J; }

    double size_of(const std::optional<StressPart> part, const Parts<Matrix3> &P, const PointState &p)
    {
      return part ? cauchy(P[*part], p).norm() : 0.;
    }

    double size_of_laws(const Parts<Matrix3> &P, const PointState &p)
    {
      return cauchy(std::accumulate(P.laws.begin(), P.laws.end(), Matrix3()), p).norm();
    }

    double shear_modulus(const Muscle3dParameters &m, const PointState &p)
    {
      return 2 * p.material[material_yeoh] + (1 - p.material[material_fat]) * m.tissue(p.material_id).shear_modulus_of_laws();
    }

    /// Cauchy stress of all parts together [Pa].
    Matrix3 whole_stress(const Muscle3dParameters &m, const Activation &a, const PointState &p)
    {
      return cauchy(stress_parts(m, a, p).total(), p);
    }

    /// sqrt(3/2 s : s) of the deviator s.
    double von_mises(const Matrix3 &stress)
    {
      const double mean = (stress[0][0] + stress[1][1] + stress[2][2]) / 3;
      double       sum  = 0;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          sum += (stress[i][j] - (i == j ? mean : 0)) * (stress[i][j] - (i == j ? mean : 0));
      return std::sqrt(1.5 * sum);
    }

    /// Green's strain (F^T F - 1) / 2.
    Matrix3 green_strain(const PointState &p)
    {
      Matrix3 strain = transpose(p.F) * p.F;
      for (unsigned int i = 0; i < 3; ++i)
        strain[i][i] -= 1;
      return strain / 2;
    }

    dealii::SymmetricTensor<2, 3> symmetric_part(const Matrix3 &matrix)
    {
      dealii::SymmetricTensor<2, 3> symmetric;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
          symmetric[i][j] = (matrix[i][j] + matrix[j][i]) / 2;
      return symmetric;
    }

    /// Of a symmetric matrix, the largest first.
    double principal_value(const Matrix3 &matrix, const unsigned int which) { return dealii::eigenvalues(symmetric_part(matrix))[which]; }

    /// Components and principal values of Cauchy's stress and Green's strain, and what follows from them.
    void add_tensor_fields(std::vector<ScalarField> &fields)
    {
      using Parameters = Muscle3dParameters;
      for (const auto &[name, i, j] :
           {std::tuple<const char *, int, int>{"xx", 0, 0}, {"yy", 1, 1}, {"zz", 2, 2}, {"xy", 0, 1}, {"yz", 1, 2}, {"zx", 2, 0}})
        {
          const int row = i, column = j;
          fields.push_back(
              {std::string("stress ") + name, "Pa", [row, column](const Parameters &m, const Activation &a, const PointState &p) {
                 return whole_stress(m, a, p)[row][column];
               }});
          fields.push_back(
              {std::string("green strain ") + name, "",
               [row, column](const Parameters &, const Activation &, const PointState &p) { return green_strain(p)[row][column]; }});
        }
      for (const unsigned int which : {0u, 1u, 2u})
        {
          const std::string number = std::to_string(which + 1);
          fields.push_back({"principal stress " + number, "Pa", [which](const Parameters &m, const Activation &a, const PointState &p) {
                              return principal_value(whole_stress(m, a, p), which);
                            }});
          fields.push_back({"principal green strain " + number, "", [which](const Parameters &, const Activation &, const PointState &p) {
                              return principal_value(green_strain(p), which);
                            }});
        }
      fields.push_back({"von mises stress", "Pa",
                        [](const Parameters &m, const Activation &a, const PointState &p) { return von_mises(whole_stress(m, a, p)); }});
    }

    std::vector<ScalarField> scalar_fields()
    {
      using Parameters = Muscle3dParameters;
      std::vector<ScalarField> fields{
          {"pressure", "Pa", [](const Parameters &, const Activation &, const PointState &p) { return p.pressure; }},
          {"dilatation", "", [](const Parameters &, const Activation &, const PointState &p) { return p.dilatation; }},
          {"jacobian", "", [](const Parameters &, const Activation &, const PointState &p) { return p.J; }},
          {"stretch", "", [](const Parameters &, const Activation &, const PointState &p) { return p.stretch; }},
          {"strain rate", "", [](const Parameters &, const Activation &, const PointState &p) { return p.strain_rate; }},
          {"pennation", "degree", [](const Parameters &, const Activation &, const PointState &p) { return p.pennation; }},
          {"active stress", "Pa",
           [](const Parameters &m, const Activation &a, const PointState &p) {
             return cauchy(stress_parts(m, a, p)[muscle_active], p).norm();
           }},
          {"passive stress", "Pa",
           [](const Parameters &m, const Activation &a, const PointState &p) {
             return size_of(passive_fibre_part(p.material_id), stress_parts(m, a, p), p);
           }},
          {"base stress", "Pa",
           [](const Parameters &m, const Activation &a, const PointState &p) {
             return size_of(base_part(p.material_id), stress_parts(m, a, p), p);
           }},
          {"law stress", "Pa",
           [](const Parameters &m, const Activation &a, const PointState &p) { return size_of_laws(stress_parts(m, a, p), p); }},
          {"tissue", "", [](const Parameters &, const Activation &, const PointState &p) { return p.material[material_tissue]; }},
          {"maximum isometric stress", "Pa",
           [](const Parameters &, const Activation &, const PointState &p) { return p.material[material_passive]; }},
          {"shear modulus", "Pa", [](const Parameters &m, const Activation &, const PointState &p) { return shear_modulus(m, p); }},
          {"bulk modulus", "Pa", [](const Parameters &, const Activation &, const PointState &p) { return p.material[material_bulk]; }},
          {"density", "kg/m^3", [](const Parameters &, const Activation &, const PointState &p) { return p.material[material_density]; }},
          {"fat fraction", "", [](const Parameters &, const Activation &, const PointState &p) { return p.material[material_fat]; }},
          {"activation", "",
           [](const Parameters &, const Activation &a, const PointState &p) {
             return p.material[material_active] == 0 ? 0. : a.at(p.material[material_region]);
           }},
          {"acoustic eigenvalue", "Pa",
           [](const Parameters &m, const Activation &a, const PointState &p) { return smallest_acoustic_eigenvalue(m, a, p); }}};
      add_tensor_fields(fields);
      return fields;
    }

    std::vector<PointField> vector_fields()
    {
      using Parameters = Muscle3dParameters;
      return {{"fibre direction", "", 3, [](const Parameters &, const Activation &, const PointState &p) { return p.fibre / p.stretch; }},
              {"fibre direction at rest", "", 3,
               [](const Parameters &, const Activation &, const PointState &p) { return invert(p.F) * p.fibre; }}};
    }

    template <typename Field>
    const Field *find_named(const std::vector<Field> &fields, const std::string &name)
    {
      const auto found = std::find_if(fields.begin(), fields.end(), [&name](const Field &field) { return field.name == name; });
      return found == fields.end() ? nullptr : &*found;
    }
  } // namespace

  const std::vector<PointField> &point_fields()
  {
    static const std::vector<PointField> fields = [] {
      std::vector<PointField> all = vector_fields();
      for (const ScalarField &field : scalar_fields())
        all.push_back(
            {field.name, field.unit, 1, [value = field.value](const Muscle3dParameters &m, const Activation &a, const PointState &p) {
               return Vector3({value(m, a, p), 0, 0});
             }});
      return all;
    }();
    return fields;
  }

  std::vector<PointField> law_fields(const Muscle3dParameters &parameters)
  {
    std::vector<PointField> fields;
    for (const LawPart &law : parameters.law_parts())
      fields.push_back({stress_of_law + law.name, "Pa", 1,
                        [place = fields.size()](const Muscle3dParameters &m, const Activation &a, const PointState &p) {
                          return Vector3({cauchy(stress_parts(m, a, p).laws[place], p).norm(), 0, 0});
                        }});
    return fields;
  }

  const std::vector<PrincipalField> &principal_fields()
  {
    static const std::vector<PrincipalField> fields = [] {
      std::vector<PrincipalField> all;
      for (const unsigned int which : {0u, 1u, 2u})
        {
          const std::string number = std::to_string(which + 1);
          all.push_back({"principal stress direction " + number, whole_stress, which});
          all.push_back({"principal green strain direction " + number,
                         [](const Muscle3dParameters &, const Activation &, const PointState &p) { return green_strain(p); }, which});
        }
      return all;
    }();
    return fields;
  }

  Vector3 principal_direction(const dealii::SymmetricTensor<2, 3> &tensor, const unsigned int which)
  {
    const auto   pairs = dealii::eigenvectors(tensor, dealii::SymmetricTensorEigenvectorMethod::jacobi);
    const double apart = 1e-10 * tensor.norm();
    for (const unsigned int other : {0u, 1u, 2u})
      if (other != which && !(std::abs(pairs[other].first - pairs[which].first) > apart))
        return {};
    const Vector3 direction = pairs[which].second;
    unsigned int  greatest  = 0;
    for (const unsigned int c : {1u, 2u})
      if (std::abs(direction[c]) > (1 + 1e-9) * std::abs(direction[greatest]))
        greatest = c;
    return direction[greatest] < 0 ? -direction : direction;
  }

  const PointField *find_point_field(const std::string &name, const std::vector<PointField> &more)
  {
    const PointField *found = find_named(point_fields(), name);
    return found != nullptr ? found : find_named(more, name);
  }

  const PrincipalField *find_principal_field(const std::string &name) { return find_named(principal_fields(), name); }
} // namespace myolines
