// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/muscle3d/point_states.h>

#include <myolines/muscle3d/loads.h>
#include <myolines/muscle3d/surface_forces.h>

#include <deal.II/base/symmetric_tensor.h>

#include <limits>
#include <set>

namespace myolines
{
  namespace
  {
    constexpr double slack = 1e-12; // of the length, for points at the border of the slab

    /// Sums over the points of the slab, or over those nearest to its middle where it has none; over nothing without a line of action.
    class SlabSums
    {
    public:
      SlabSums(const Muscle3dSystem &system, const SlabRule rule)
        : line_(system.line_of_action().line)
        , rule_(rule)
        , element_(system.discretisation().element)
      {}

      void add(const NodeSpace::Cell &cell, const int q, const PointState &p)
      {
        if (!line_)
          return;
        const double tolerance = slack * line_->length;
        const double distance  = rule_ == SlabRule::whole_cells ? distance_of(cell->center(), 0) : // exact comparison, as Flexodeal
                                    distance_of(point_position(element_, cell, q), slack);
        if (distance > distance_ + tolerance)
          return;
        if (distance < distance_ - tolerance)
          clear();
        distance_       = std::min(distance, distance_);
        const double dv = p.JxW * p.J;
        volume_ += dv;
        stretch_ += dv * p.stretch;
        pennation_ += dv * p.pennation;
        strain_rate_ += dv * p.strain_rate;
        velocity_ += dv * p.velocity;
      }

      /// Of all ranks; no numbers where there is no muscle.
      void means(BodyMeasures &m, const MPI_Comm communicator)
      {
        if (line_ && distance_ > dealii::Utilities::MPI::min(distance_, communicator) + slack * line_->length)
          clear();
        for (double *x : {&volume_, &stretch_, &pennation_, &strain_rate_, &velocity_[0], &velocity_[1], &velocity_[2]})
          *x = dealii::Utilities::MPI::sum(*x, communicator);
        const double weight = volume_ > 0 ? 1 / volume_ : std::numeric_limits<double>::quiet_NaN();
        m.slab_volume       = volume_;
        m.mean_stretch      = weight * stretch_;
        m.mean_pennation    = weight * pennation_;
        m.mean_strain_rate  = weight * strain_rate_;
        m.mean_velocity     = weight * velocity_;
      }

    private:
      /// From the middle; 0 in the slab.
      double distance_of(const dealii::Point<3> &x, const double tolerance) const
      {
        return line_->in_slab(x, tolerance) ? 0 : std::abs(line_->along(x) - line_->length / 2);
      }

      void clear()
      {
        volume_ = stretch_ = pennation_ = strain_rate_ = 0;
        velocity_                                      = Vector3();
      }

      const std::optional<LineOfAction> &line_;
      SlabRule                           rule_;
      const Element                     &element_;
      double                             distance_ = std::numeric_limits<double>::infinity(); ///< of the points in the sums
      double                             volume_ = 0, stretch_ = 0, pennation_ = 0, strain_rate_ = 0;
      Vector3                            velocity_;
    };

    void add_active_powers(const Muscle3dParameters &parameters, const Activation &activation, const PointState &p, Powers &powers)
    {
      const curves::FibreCurves curves = parameters.fibre_curves();
      if (p.material[material_active] == 0)
        return;
      const double lam   = p.isochoric_stretch;
      const double power = p.JxW * p.material[material_active] * activation.at(p.material[material_region]) *
                           curves::active(lam, &curves).value * p.isochoric_rate / lam;
      powers.active_power -= power;
      if (parameters.force_velocity())
        powers.dissipation += power * (curves::force_velocity(p.isochoric_strain_rate, &curves).value - 1);
    }

    /// Of the laws at a point: what they store, as law_parts(), and what their stress does beyond that. The stress at rest of laws without
    /// an energy works as the active one does; what rates add is dissipated.
    void add_laws(const Muscle3dParameters &parameters, const Activation &activation, const PointState &p, Powers &powers,
                  std::vector<double> &stored)
    {
      const auto &tissue = parameters.tissue(p.material_id);
      if (tissue.laws.empty())
        return;
      const curves::FibreCurves curves = parameters.fibre_curves();
      Deformation<double>       at     = deformation(parameters, activation, p, curves);
      const auto                moving = strain(at);
      at.F_rate                        = Mat3<double>::zero();
      const auto still                 = strain(at);
      const auto power                 = [&](const Mat3<double> &P) { // of the motion, which quasi-static stresses do not see
        double sum = 0;
        for (int i = 0; i < 9; ++i)
          sum += P.entry[i] * p.F_rate[i / 3][i % 3];
        return sum;
      };
      auto to = stored.begin() + parameters.first_law(p.material_id);
      for (const TissuePart &part : tissue.laws)
        {
          const double       weight = p.JxW * weight_of(part, p);
          const Mat3<double> P = part.law->stress(moving), P_still = part.law->stress(still);
          if (const std::optional<double> energy = part.law->energy(still))
            *to += weight * *energy;
          else
            powers.active_power -= weight * power(P_still);
          ++to;
          powers.dissipation += weight * power(P - P_still);
        }
    }

    /// Powers of loads and supports, and what dashpots dissipate. Returns the energy of springs [J].
    double add_load_powers(const Muscle3dSystem &system, const State &state, const Side side, Powers &powers)
    {
      SurfaceForces::Work work;
      if (system.surface_forces().any())
        work = system.surface_forces().work({state.t, side, state.u, state.v, state.a});
      powers.traction_power = work.power;
      powers.dissipation += work.dissipation;
      if (system.loads().any_external())
        {
          powers.traction_power += system.loads().load_power(state.t, side, state.v);
          powers.body_force_power = system.loads().body_force_power(state.t, state.v);
        }
      return work.energy;
    }

    void add_energies(const Muscle3dParameters &parameters, const Activation &activation, const PointState &p, BodyMeasures &m)
    {
      const curves::FibreCurves curves   = parameters.fibre_curves();
      const double             *material = p.material.data();
      const double              lam = p.isochoric_stretch, I1 = std::pow(p.J, -2. / 3) * p.F.norm_square(), D = p.dilatation;
      m.stored_volumetric += VolumeEnergy<double>(parameters.volume_form, p.JxW * material[material_bulk]).energy(D);
      m.stored_base += p.JxW * Yeoh<>(material + material_yeoh).energy_of(I1);
      m.stored_passive += p.JxW * material[material_passive] * curves::passive_energy(lam, &curves);
      m.stored_tendinous += p.JxW * material[material_tendon] * curves::tendon_energy(lam, &curves);
      if (parameters.dynamic)
        m.kinetic += p.JxW * material[material_density] / 2 * p.velocity.norm_square();
      if (!activation.zero())
        add_active_powers(parameters, activation, p, m);
      add_laws(parameters, activation, p, m, m.stored_by_law);

      const Matrix3        gradient = p.F - Matrix3(dealii::unit_symmetric_tensor<3>());
      const Parts<Matrix3> P        = stress_parts(parameters, activation, p);
      // (Grad U) F^(-1) : tau with tau = P F^T
      const auto density = [&](const Matrix3 &stress) { return p.JxW * scalar_product(gradient * invert(p.F), stress * transpose(p.F)); };
      m.work_density.for_each(P, [&](double &to, const Matrix3 &stress) { to += density(stress); });
    }

    /// Sums over all ranks.
    void reduce(BodyMeasures &m, const MPI_Comm communicator)
    {
      for (double *x : {&m.volume, &m.kinetic, &m.stored_volumetric, &m.stored_base, &m.stored_passive, &m.stored_tendinous,
                        &m.active_power, &m.dissipation, &m.l2_displacement, &m.l2_pressure})
        *x = dealii::Utilities::MPI::sum(*x, communicator);
      for (double &x : m.stored_by_law)
        m.stored_laws += x = dealii::Utilities::MPI::sum(x, communicator);
      m.work_density.for_each([&](double &x) { x = dealii::Utilities::MPI::sum(x, communicator); });
      m.min_jacobian = dealii::Utilities::MPI::min(m.min_jacobian, communicator);
      m.max_jacobian = dealii::Utilities::MPI::max(m.max_jacobian, communicator);
    }
  } // namespace

  BodyMeasures measure_body(const Muscle3dSystem &system, const State &state, const SlabRule rule, const Side side)
  {
    const Muscle3dParameters &parameters = system.parameters();
    const Activation          activation = system.activation(state.t, side);
    SlabSums                  slab(system, rule);
    BodyMeasures              m;
    m.stored_by_law.resize(parameters.law_parts().size());
    m.min_jacobian = std::numeric_limits<double>::max();
    m.max_jacobian = std::numeric_limits<double>::lowest();

    PointStates(system, state).for_each([&](const NodeSpace::Cell &cell, const int q, const PointState &p) {
      m.volume += p.JxW * p.J;
      m.min_jacobian = std::min(m.min_jacobian, p.J);
      m.max_jacobian = std::max(m.max_jacobian, p.J);
      m.l2_displacement += p.JxW * p.displacement.norm_square();
      m.l2_pressure += p.JxW * p.pressure * p.pressure;
      add_energies(parameters, activation, p, m);
      if (p.material_id == muscle_id)
        slab.add(cell, q, p);
    });
    m.work_density.laws.resize(m.stored_by_law.size()); // of ranks without cells, too
    reduce(m, system.discretisation().communicator);
    slab.means(m, system.discretisation().communicator);

    m.work_density.for_each([&](double &x) { x /= m.volume; });
    m.l2_displacement = std::sqrt(m.l2_displacement);
    m.l2_pressure     = std::sqrt(m.l2_pressure);
    m.stored_springs  = add_load_powers(system, state, side, m);
    return m;
  }

  Powers measure_powers(const Muscle3dSystem &system, const State &state, const Side side)
  {
    Powers           powers;
    const Activation activation = system.activation(state.t, side);
    const bool       active     = !activation.zero();
    if (active || system.parameters().any_laws())
      {
        std::vector<double> stored(system.parameters().law_parts().size());
        PointStates(system, state).for_each([&](const NodeSpace::Cell &, int, const PointState &p) {
          if (active)
            add_active_powers(system.parameters(), activation, p, powers);
          add_laws(system.parameters(), activation, p, powers, stored);
        });
        for (double *x : {&powers.active_power, &powers.dissipation})
          *x = dealii::Utilities::MPI::sum(*x, system.discretisation().communicator);
      }
    add_load_powers(system, state, side, powers);
    return powers;
  }

  MiddleSize measure_middle(const Muscle3dSystem &system, const State &state, const Vector3 &thickness)
  {
    const NodeSpace             &space = *system.discretisation().space;
    const LineOfAction          &line  = system.line_of_action().line.value();
    const std::array<Vector3, 2> across{{cross_product_3d(thickness, line.direction), thickness}};
    std::array<double, 4>        far{}; // -min and max along the width, along the thickness
    far.fill(std::numeric_limits<double>::lowest());
    for (const auto node : space.nodes().locally_owned_dofs())
      if (const dealii::Point<3> &X = space.node_position(node); line.in_slab(X, slack))
        {
          const Vector3 x = X + Vector3({state.u(3 * node), state.u(3 * node + 1), state.u(3 * node + 2)});
          for (unsigned int c = 0; c < 2; ++c)
            {
              far[2 * c]     = std::max(far[2 * c], -(x * across[c]));
              far[2 * c + 1] = std::max(far[2 * c + 1], x * across[c]);
            }
        }
    for (double &x : far)
      x = dealii::Utilities::MPI::max(x, space.communicator());
    return {far[0] + far[1], far[2] + far[3]};
  }

  std::optional<Vector3> thickness_direction(const Muscle3dSystem &system)
  {
    const std::optional<LineOfAction> &line = system.line_of_action().line;
    if (!line || line->thickness)
      return line ? line->thickness : std::nullopt;
    const State                   still   = system.still_state();
    const Element                &element = system.discretisation().element;
    dealii::SymmetricTensor<2, 3> leaning; // int b (x) b over the slab, b the part of the fibre direction across the line
    double                        volume = 0;
    PointStates(system, still).for_each([&](const NodeSpace::Cell &cell, const int q, const PointState &p) {
      if (p.material_id != muscle_id || !line->in_slab(point_position(element, cell, q), slack))
        return;
      const Vector3 b = p.fibre - (p.fibre * line->direction) * line->direction;
      leaning += p.JxW * symmetrize(outer_product(b, b));
      volume += p.JxW;
    });
    leaning                   = dealii::Utilities::MPI::sum(leaning, system.discretisation().communicator);
    volume                    = dealii::Utilities::MPI::sum(volume, system.discretisation().communicator);
    const auto       modes    = dealii::eigenvectors(leaning); // descending
    constexpr double least    = 3e-4;                          // sine squared of a degree
    constexpr double distinct = 0.9;
    if (!(modes[0].first > least * volume) || modes[1].first > distinct * modes[0].first)
      return std::nullopt;
    return modes[0].second;
  }

  namespace
  {
    /// Velocities of constrained unknowns without what they owe to free ones: relations between unknowns do no work, whatever is left of
    /// the equations at the end of a step.
    Vector prescribed_velocity(const Muscle3dSystem &system, const Vector &v)
    {
      Vector owed(v);
      owed.zero_out_ghost_values();
      const Constraints &lines = system.constraints();
      for (const auto i : owed.locally_owned_elements())
        if (lines.is_constrained(i))
          owed(i) = 0;
      system.discretisation().apply_relations(owed);
      owed.zero_out_ghost_values();
      for (const auto i : owed.locally_owned_elements())
        owed(i) = lines.is_constrained(i) ? v(i) - owed(i) : 0;
      return owed;
    }
  } // namespace

  std::vector<Reaction> measure_reactions(const Muscle3dSystem &system, const State &state, const Side side)
  {
    const NodeSpace &space = *system.discretisation().space;
    Vector           r     = space.make_vector();
    system.residual({state.t, side, state.u, state.v, state.a}, r);
    const Vector v = prescribed_velocity(system, state.v);

    // On an edge that two faces share the later condition holds, and the reaction is its own.
    std::vector<Reaction>                     reactions;
    std::set<dealii::types::global_dof_index> taken;
    const auto                               &conditions = system.parameters().boundary;
    const auto                               &ties       = system.discretisation().constraints.held;
    for (auto condition = conditions.rbegin(); condition != conditions.rend(); ++condition)
      {
        const BoundaryFacts &facts = (*condition)->facts();
        if (!facts.reacts())
          continue;
        std::array<bool, 3> components = facts.prescribed;
        if (const auto tie = ties.find(facts.name); tie != ties.end())
          for (unsigned int c = 0; c < 3; ++c)
            components[c] = components[c] || tie->second[c];
        Reaction     reaction{facts.name, {}, 0, {}};
        FaceReaction face;
        if (facts.constrains())
          for (const auto node : space.face_nodes(facts.face))
            {
              Vector3 pull, place; // the place counts where there is a pull
              for (unsigned int c = 0; c < 3; ++c)
                if (const auto i = 3 * node + c; components[c] && space.owned_unknowns().is_element(i) && taken.insert(i).second)
                  {
                    pull[c] = r(i);
                    reaction.power += r(i) * v(i);
                  }
              if (space.owned_unknowns().is_element(3 * node))
                for (unsigned int c = 0; c < 3; ++c)
                  place[c] = space.node_position(node)[c] + state.u(3 * node + c);
              face.constraint += pull;
              face.moment += cross_product_3d(place, pull);
            }
        face.constraint = dealii::Utilities::MPI::sum(face.constraint, space.communicator());
        face.moment     = dealii::Utilities::MPI::sum(face.moment, space.communicator());
        reaction.power  = dealii::Utilities::MPI::sum(reaction.power, space.communicator());
        if (facts.pushes)
          face.support = system.surface_forces().force({state.t, side, state.u, state.v, state.a}, **condition);
        if (facts.loads)
          face.load = system.surface_forces().load(state.t, side, **condition);
        reaction.force = face.constraint + face.support + face.load;
        reaction.own   = (*condition)->own_columns(state.t, side, face);
        reactions.insert(reactions.begin(), reaction);
      }
    return reactions;
  }

  double energy(const BodyMeasures &body)
  {
    return body.kinetic + body.stored_volumetric + body.stored_base + body.stored_passive + body.stored_tendinous + body.stored_laws +
           body.stored_springs;
  }

  EnergyRates energy_rates(const Powers &powers, const std::vector<Reaction> &reactions)
  {
    EnergyRates rates{powers.active_power, powers.dissipation, powers.body_force_power + powers.traction_power};
    for (const Reaction &reaction : reactions)
      rates.external += reaction.power;
    return rates;
  }

  Energetics Muscle3dSystem::energetics(const State &state, const Side side) const
  {
    const BodyMeasures body = measure_body(*this, state, SlabRule::quadrature_points, side);
    return {energy(body), energy_rates(body, measure_reactions(*this, state, side))};
  }
} // namespace myolines
