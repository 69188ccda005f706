// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/muscle3d/point_states.h>

#include <limits>

namespace myolines
{
  PointStates::PointStates(const Muscle3dSystem &system, const State &state)
    : parameters_(system.parameters())
    , line_(system.line_of_action().line)
    , d_(system.discretisation())
    , model_(kernel_model(parameters_, {}))
    , sweep_(system.sweep())
    , u_(state.u)
    , v_(state.v)
    , values_(std::size_t(d_.element.n_points) * n_point_values * n_lanes)
  {}

  void PointStates::evaluate(const unsigned int batch)
  {
    batch_ = batch;
    d_.kernels.points(d_.tables, model_, sweep_.cells(batch), u_.begin(), v_.begin(), values_.data(), d_.scratch());
  }

  PointState PointStates::point(const int q, const unsigned int lane) const
  {
    const double *at    = &values_[std::size_t(q) * n_point_values * n_lanes + lane];
    const auto    value = [&](const int k) { return at[k * n_lanes]; };
    PointState    p;
    for (int i = 0; i < 9; ++i)
      {
        p.F[i / 3][i % 3]      = value(point_F + i);
        p.F_rate[i / 3][i % 3] = value(point_F_rate + i);
      }
    for (int c = 0; c < 3; ++c)
      {
        p.displacement[c] = value(point_displacement + c);
        p.velocity[c]     = value(point_velocity + c);
      }
    p.pressure   = value(point_pressure);
    p.dilatation = value(point_dilatation);
    p.JxW        = value(point_JxW);

    p.material    = sweep_.materials.at(batch_, q, lane);
    p.material_id = static_cast<unsigned int>(p.material[material_tissue]);
    const Vector3 a0({p.material[0], p.material[1], p.material[2]});
    p.J                     = determinant(p.F);
    p.fibre                 = p.F * a0;
    p.stretch               = p.fibre.norm();
    p.isochoric_stretch     = p.stretch / std::cbrt(p.J);
    const double growth     = p.fibre * (p.F_rate * a0) / (p.stretch * p.stretch); // of ln |a|
    const double swelling   = trace(invert(p.F) * p.F_rate);                       // of ln J
    const double e0         = 1 / p.material[material_slowness];
    p.isochoric_rate        = p.isochoric_stretch * (growth - swelling / 3);
    p.strain_rate           = p.stretch * growth / e0;
    p.isochoric_strain_rate = p.isochoric_rate / e0;
    p.pennation             = line_ ? line_->angle_to(p.fibre) : std::numeric_limits<double>::quiet_NaN();
    return p;
  }

  std::optional<StressPart> base_part(const unsigned int material_id)
  {
    switch (material_id)
      {
      case muscle_id:
        return muscle_base;
      case aponeurosis_id:
        return aponeurosis_base;
      case tendon_id:
        return tendon_base;
      default:
        return std::nullopt;
      }
  }

  std::optional<StressPart> passive_fibre_part(const unsigned int material_id)
  {
    switch (material_id)
      {
      case muscle_id:
        return muscle_passive;
      case aponeurosis_id:
        return aponeurosis_fibre;
      case tendon_id:
        return tendon_fibre;
      default:
        return std::nullopt;
      }
  }

  Deformation<double> deformation(const Muscle3dParameters &parameters, const Activation &activation, const PointState &p,
                                  const curves::FibreCurves &curves)
  {
    Deformation<double> at;
    for (int i = 0; i < 3; ++i)
      {
        at.a0[i] = p.material[material_direction + i];
        for (int j = 0; j < 3; ++j)
          {
            at.F(i, j)      = p.F[i][j];
            at.F_rate(i, j) = parameters.dynamic ? p.F_rate[i][j] : 0;
          }
      }
    at.activation = activation.at(p.material[material_region]);
    at.curves     = &curves;
    return at;
  }

  namespace
  {
    /// Of all laws; zero of those of other tissues.
    std::vector<Matrix3> law_stresses(const Muscle3dParameters &parameters, const Activation &activation, const PointState &p,
                                      const curves::FibreCurves &curves)
    {
      std::vector<Matrix3> stresses;
      if (!parameters.any_laws())
        return stresses;
      const auto at = strain(deformation(parameters, activation, p, curves));
      for (const auto &[id, tissue] : parameters.tissues)
        for (const TissuePart &part : tissue.laws)
          {
            Matrix3 P;
            if (id == p.material_id)
              {
                const Mat3<double> of_law = part.law->stress(at);
                for (int i = 0; i < 9; ++i)
                  P[i / 3][i % 3] = weight_of(part, p) * of_law.entry[i];
              }
            stresses.push_back(P);
          }
      return stresses;
    }
  } // namespace

  Parts<Matrix3> stress_parts(const Muscle3dParameters &parameters, const Activation &activation, const PointState &p)
  {
    const KernelModel       model  = kernel_model(parameters, activation);
    const TissueParameters &tissue = parameters.tissue(p.material_id);
    const Matrix3           H      = transpose(invert(p.F));
    const double            power = std::pow(p.J, -2. / 3), I1 = power * p.F.norm_square(), lam = p.isochoric_stretch;
    const Vector3           a0({p.material[0], p.material[1], p.material[2]});
    const Matrix3           G = lam * (outer_product(p.fibre, a0) / p.fibre.norm_square() - H / 3.), Q = 2 * power * p.F - 2. / 3 * I1 * H;
    const double            fat      = p.material[material_fat];
    const double            fat_base = fat == 0 ? 0. : fat * Yeoh<>(tissue.fat.base.coefficients().data()).response(I1).first;

    Parts<Matrix3> parts;
    parts[volumetric_part] = p.pressure * p.J * H;
    if (const auto base = base_part(p.material_id))
      parts[*base] = (Yeoh<>(p.material.data() + material_yeoh).response(I1).first - fat_base) * Q;
    if (const auto fibre = passive_fibre_part(p.material_id))
      parts[*fibre] = fibre_stress(p.material.data(), {true, false, false, true, &activation, &model.curves}, lam, 0.).g * G;
    if (model.active)
      parts[muscle_active] = p.material[material_active] * activation.at(p.material[material_region]) *
                             curves::active(lam, &model.curves).value *
                             (model.rate ? curves::force_velocity(p.isochoric_strain_rate, &model.curves).value : 1.) / lam * G;
    if (fat != 0)
      parts[fat_part] = fat_base * Q;
    parts.laws = law_stresses(parameters, activation, p, model.curves);
    return parts;
  }
} // namespace myolines
