// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/counted.h>
#include <myolines/muscle3d/discretisation.h>
#include <myolines/muscle3d/loads.h>
#include <myolines/muscle3d/muscle3d_system.h>
#include <myolines/muscle3d/surface_forces.h>

#include <algorithm>

namespace myolines
{
  namespace
  {
    /// "load (x+)" of all conditions of which @p says is not empty, with what it says.
    std::string list_conditions(const Muscle3dParameters &p, const std::string BoundaryFacts::*says)
    {
      std::string text;
      for (const BoundaryFacts &condition : facts_of(p.boundary))
        if (const std::string &what = condition.*says; !what.empty())
          text += (text.empty() ? "" : ", ") + condition.name + " (" + face_names(p.geometry)[condition.face] + ") " + what;
      return text;
    }

    /// Conditions whose force follows their face, and which of them store an energy.
    std::string list_followers(const Muscle3dParameters &p, const SurfaceForces &forces)
    {
      std::string text;
      for (const auto &condition : p.boundary)
        if (const BoundaryFacts &facts = condition->facts(); facts.follows)
          {
            const std::string &why = forces.why_no_potential(*condition);
            text += (text.empty() ? "" : ", ") + facts.name + " (" + face_names(p.geometry)[facts.face] + ") " +
                    (why.empty() ? "has an energy" : "has no energy, " + why);
          }
      return text;
    }

    /// Those of all ranks, each counted once: relations that only say that an unknown is zero are none between unknowns.
    std::size_t count_relations(const Muscle3dDiscretisation &d)
    {
      const dealii::IndexSet &owned = d.space->owned_unknowns();
      const std::size_t       own   = std::count_if(d.constraints.relations.begin(), d.constraints.relations.end(),
                                                    [&](const Relation &r) { return !r.others.empty() && owned.is_element(r.unknown); });
      return dealii::Utilities::MPI::sum(own, d.communicator);
    }
  } // namespace

  std::vector<std::string> Muscle3dSystem::plan() const
  {
    const Muscle3dParameters &p    = parameters_;
    const auto                line = [](const std::string &term, const bool on, const std::string &why) {
      return std::string(on ? "on   " : "off  ") + term + ": " + why;
    };
    const bool               rates = p.force_velocity();
    std::vector<std::string> lines;
    if (p.geometry.mesh)
      lines = p.geometry.mesh->report;
    lines.push_back(line("inertia", p.dynamic, p.dynamic ? "dynamic" : "quasi-static: no mass matrix is built"));
    lines.push_back(line("active stress", p.active(),
                         p.active() ? "activation is given; skipped while it is zero up to the next event"
                                    : "no activation, or an activation that is always zero"));
    if (!p.regions.empty())
      lines.push_back(line("regions of activation", true, std::to_string(p.regions.size()) + ", each with a drive of its own"));
    if (p.curves)
      lines.push_back(line("curves of the thesis", false, "tissues/curves gives others"));
    lines.push_back(line("force-velocity", rates,
                         rates                              ? "dynamic and active"
                         : !p.dynamic                       ? "quasi-static: sV = 1"
                         : !p.muscle().fibre.force_velocity ? "switched off for the tissue"
                                                            : "nothing is active"));
    const bool printed = p.has_muscle || p.tissues.count(aponeurosis_id) + p.tissues.count(tendon_id) > 0;
    lines.push_back(line("passive fibres and base material", printed, printed ? "always" : "all cells are of tissues of the scene's own"));
    for (const LawPart &law : p.law_parts())
      lines.push_back(
          line(law.name, true, law.part->law->kind.name + (law.part->law->kind.rates == Rates::none ? "" : ", of strain rates")));
    lines.push_back(line("body force", p.body_force.has_value(), p.body_force ? "given" : "not given"));
    lines.push_back(line("tractions", std::any_of(p.boundary.begin(), p.boundary.end(), [](const auto &c) { return !c->facts().reacts(); }),
                         "faces without a condition are free"));
    if (const std::string motions = list_conditions(p, &BoundaryFacts::says_motion); !motions.empty())
      lines.push_back(line("motion of faces", true, motions));
    const std::string ties = list_conditions(p, &BoundaryFacts::says_tie), springs = list_conditions(p, &BoundaryFacts::says_spring);
    lines.push_back(line("ties", !ties.empty(),
                         ties.empty() ? "no face is a symmetry plane or moves as one"
                                      : ties + "; " + counted(count_relations(*discretisation_), "relation") + " between unknowns"));
    lines.push_back(line("springs at faces", !springs.empty(), springs.empty() ? "no foundation, tendon or stop" : springs));
    if (const std::string followers = list_followers(p, *surface_forces_); !followers.empty())
      lines.push_back(line("pressures that follow their face", true, followers));
    lines.push_back(std::string("tangent: ") + (capabilities().symmetric_tangent ? "symmetric" : "exact, not symmetric") +
                    "; kernels: " + name(discretisation_->instruction_set) + ", " + std::to_string(n_lanes) + " cells at once");
    return lines;
  }

  Muscle3dSizes estimate_sizes(const Muscle3dParameters &parameters, const unsigned int ranks)
  {
    const Geometry &block  = parameters.geometry;
    const double    k      = parameters.degree;
    const double    halves = std::exp2(block.refinement);
    Muscle3dSizes   sizes;
    sizes.n_cells    = 1;
    sizes.n_unknowns = 3;
    for (const unsigned int cells : block.cells)
      {
        sizes.n_cells *= cells * halves;
        sizes.n_unknowns *= k * cells * halves + 1;
      }
    // Cells of a rank with one layer of ghosts, were its part a cube; no more than there are.
    const double own      = std::max(1., sizes.n_cells / ranks);
    const double seen     = std::min(sizes.n_cells, std::pow(std::cbrt(own) + 2, 3));
    const double unknowns = sizes.n_unknowns / ranks;
    const double nodes    = std::pow(k + 1, 3);
    const double modes    = k * (k + 1) * (k + 2) / 6;
    const double row      = 3 * std::pow(2 * k + 1, 3); // most entries of a row of a regular mesh
    const double mesh     = 2000;                       // bytes of a cell in mesh and numbering, measured

    const double points = std::pow(parameters.n_points, 3);
    const double star   = 3 * std::pow(2 * k - 1, 3); // unknowns of a vertex star
    const int    fields =
        (parameters.force_velocity() ? tangent_size_rate : tangent_size_0) + (keeps_gradient(widest_instruction_set()) ? 9 : 0);
    const double tangents = fields * sizeof(float) * own; // of a point

    sizes.matrix_bytes = unknowns * row * (sizeof(double) + sizeof(int)) + seen * nodes * (3 * nodes + 1) * sizeof(int);
    sizes.bytes        = 21 * unknowns * sizeof(double) + seen * (mesh + nodes * sizeof(int) + (10 + modes * modes) * sizeof(double));
    // A number in single precision, two where F is kept, the volume of each cell, and the stiffness that eliminations of the pressure keep.
    const int parts     = keeps_gradient(widest_instruction_set()) ? 2 : 1;
    sizes.tangent_bytes = points * parts * tangents + own * (VolumeLayout(static_cast<int>(modes)).size + modes * modes) * sizeof(double);
    if (k > 1)
      {
        const double entry  = widest_instruction_set() == InstructionSet::baseline ? sizeof(float) : sizeof(float) / 2.;
        const double places = seen * 8 * (3 * std::pow(k, 3) * sizeof(short) + sizeof(int)); // of entries of cells
        sizes.patch_bytes   = own * star * ((star + 1) / 2 * entry + sizeof(float) + sizeof(int)) + places;
        // The pattern of rows of 81 entries and where cells add to them, their hierarchy, and their copy of 40 bytes for a block of nine;
        // interpolation. The entries themselves are there in set-ups alone, when there are no Krylov vectors.
        const double coarse = unknowns / std::pow(k, 3);
        sizes.coarse_bytes  = coarse * 81 * (sizeof(double) + 2 * sizeof(int) + 40. / 9) + seen * 8 * 24 * sizeof(int) + 20 * unknowns +
                             (parameters.n_points > k + 1 ? std::pow(k + 1, 3) * tangents : 0.);
      }
    return sizes;
  }
} // namespace myolines
