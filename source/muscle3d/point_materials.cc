// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/kernels/kernels.h>
#include <myolines/muscle3d/point_materials.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace myolines
{
  namespace
  {
    bool has_muscle(const Material &m) { return m[material_active] != 0 || m[material_passive] != 0; }
    bool has_tendon(const Material &m) { return m[material_tendon] != 0; }

    std::string text_of(const dealii::Point<3> &x)
    {
      std::ostringstream text;
      text << "(" << x << ") m";
      return text.str();
    }

    /// Why no body can be made of it; else empty.
    std::string what_is_wrong(const Material &m, const dealii::Point<3> &x)
    {
      if (!(m[material_fat] >= 0 && m[material_fat] <= 1))
        return "gives a fat fraction of " + std::to_string(m[material_fat]) + " at " + text_of(x);
      if (!(m[material_passive] >= 0))
        return "gives a negative maximum isometric stress at " + text_of(x);
      if (!(m[material_active] >= 0))
        return "gives a negative activation scale at " + text_of(x);
      if (!std::isfinite(m[0] + m[1] + m[2]))
        return "gives no fibre direction at " + text_of(x);
      return "";
    }
  } // namespace

  /// Gradients of a potential at the Gauss points of cells.
  class PointMaterials::Gradients
  {
  public:
    Gradients(const Vector &potential, const dealii::FiniteElement<3> &fe, const Element &element)
      : potential_(potential)
      , values_(fe, dealii::QGauss<3>(element.n_points_1d), dealii::update_gradients)
      , gradients_(element.n_points)
    {}

    void go_to(const NodeSpace::Cell &cell)
    {
      values_.reinit(cell);
      values_.get_function_gradients(potential_, gradients_);
    }

    std::array<double, 3> at(const int q) const { return {{gradients_[q][0], gradients_[q][1], gradients_[q][2]}}; }

  private:
    const Vector                     &potential_;
    dealii::FEValues<3>               values_;
    std::vector<dealii::Tensor<1, 3>> gradients_;
  };

  PointMaterials::PointMaterials(const Muscle3dParameters &parameters, const CellBatches &batches, const Element &element,
                                 const Vector *potential)
  {
    std::unique_ptr<Gradients> gradients;
    if (potential != nullptr && batches.n_batches() > 0)
      gradients = std::make_unique<Gradients>(*potential, batches.cell(0, 0)->get_fe(), element);
    for (const auto &[id, tissue] : parameters.tissues)
      {
        for (const TissuePart &part : tissue.laws)
          {
            laws_.push_back(part.law);
            terms_.push_back({part.law->kind.kernels.data(), part.law->data(), part.weight, id});
          }
        law_shear_[id] = tissue.shear_modulus_of_laws();
      }
    const BodyFields &fields = parameters.fields;
    points_of_region_.resize(1 + fields.regions.size());
    const MaterialField           field(fields, parameters.tissues);
    std::map<unsigned int, Batch> uniform; // by tissue
    for (unsigned int b = 0; b < batches.n_batches(); ++b)
      {
        const unsigned int id = CellId::of(batches.cell(b, 0)->material_id()).tissue;
        if (fields.of_all_tissues() || (fields.within_muscle() && (id == muscle_id || parameters.tissue(id).fibre.follows_body)))
          add_field(field, batches, element, b, gradients.get());
        else
          {
            if (uniform.count(id) == 0)
              {
                Material m         = material(parameters.tissue(id));
                m[material_tissue] = id;
                uniform[id]        = {values_.size(), 0, has_muscle(m), has_tendon(m)};
                set_laws(id, id, uniform[id]);
                for (const double x : m)
                  for (unsigned int lane = 0; lane < n_lanes; ++lane)
                    values_.push_back(x);
              }
            batches_.push_back(uniform[id]);
          }
      }
  }

  void PointMaterials::set_laws(const unsigned int first, const unsigned int last, Batch &batch) const
  {
    const auto before = [](const LawTerm &term, const unsigned int id) { return term.tissue < id; };
    const auto begin  = std::lower_bound(terms_.begin(), terms_.end(), first, before),
               end    = std::lower_bound(begin, terms_.end(), last + 1, before);
    batch.first_term  = static_cast<int>(begin - terms_.begin());
    batch.n_terms     = static_cast<int>(end - begin);
    for (const auto &[id, shear] : law_shear_)
      if (id >= first && id <= last)
        batch.shear = std::max(batch.shear, shear);
  }

  void PointMaterials::add_field(const MaterialField &field, const CellBatches &batches, const Element &element, const unsigned int b,
                                 Gradients *gradients)
  {
    constexpr unsigned int stride = n_material_values * n_lanes;
    Batch                  batch{values_.size(), stride, false, false};
    set_laws(0, CellId::n_tissues, batch);
    values_.resize(batch.first + std::size_t(element.n_points) * stride);
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        const NodeSpace::Cell &cell = batches.cell(b, lane);
        if (gradients != nullptr)
          gradients->go_to(cell);
        for (int q = 0; q < element.n_points; ++q)
          {
            const dealii::Point<3>               x = point_position(element, cell, q);
            std::optional<std::array<double, 3>> along;
            if (gradients != nullptr)
              along = gradients->at(q);
            const auto [m, distance, problem] = field.at(x, CellId::of(cell->material_id()), along);
            if (problem_.empty())
              problem_ = problem.empty() ? what_is_wrong(m, x) : problem + " at " + text_of(x);
            if (problem_.empty() && distance > cell->diameter())
              problem_ = "the table of points has none within " + std::to_string(cell->diameter()) + " m of " + text_of(x) +
                         " (it must cover the body, in metres)";
            ++points_of_region_[static_cast<unsigned int>(m[material_region])];
            batch.muscle = batch.muscle || has_muscle(m);
            batch.tendon = batch.tendon || has_tendon(m);
            for (unsigned int i = 0; i < n_material_values; ++i)
              values_[batch.first + std::size_t(q) * stride + i * n_lanes + lane] = m[i];
          }
      }
    batches_.push_back(batch);
  }

  Material PointMaterials::at(const unsigned int b, const int q, const unsigned int lane) const
  {
    const double *first = values(b) + std::size_t(q) * stride(b) + lane;
    Material      m;
    for (unsigned int i = 0; i < n_material_values; ++i)
      m[i] = first[i * n_lanes];
    return m;
  }
} // namespace myolines
