// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/parameters.h>
#include <myolines/system/ledger.h>
#include <myolines/system/semi_discrete_system.h>

#include <deal.II/base/point.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  struct Muscle3dDiscretisation;
  struct CellSweep;
  class PointMaterials;
  class Loads;
  class SurfaceForces;

  /// The 3D muscle as a second-order system in the displacement alone (physics page 1, thesis chapters 5-6):
  ///
  ///     M A + F_int(t, U, V) - F_ext(t, U) = 0,
  ///
  /// pressure and dilatation eliminated exactly, cell by cell: D_h = Pi(J), p_h = Pi(Psi_vol'(D_h)). They are its local unknowns: as
  /// functions of U they change by kappa times the square of a Newton step, as iterates they do not (Simo, Taylor and Pister,
  /// doi:10.1016/0045-7825(85)90033-7; Magisano, Leonetti and Garcea, doi:10.1002/nme.5403).
  /// Unknown 3 n + c is component c [m] of node n. Quasi-static systems ignore v and a and take sV = 1.
  class Muscle3dSystem : public SemiDiscreteSystem
  {
  public:
    /// Makes mesh, materials and constraints on the ranks of @p communicator. Collective. @throws InputError
    Muscle3dSystem(Muscle3dParameters parameters, MPI_Comm communicator, WorkLedger &ledger,
                   InstructionSet instruction_set = widest_instruction_set());
    ~Muscle3dSystem() override;

    Capabilities       capabilities() const override;
    std::size_t        n_unknowns() const override;
    State              initial_state(double t0) const override;
    const Constraints &constraints() const override;
    void               prescribed(double t, Side side, State &state) const override;
    Evaluation         residual(const Point &point, Vector &r) const override;
    LocalUnknowns      local(const Vector &u) const override; ///< D and p by batch, [2][n_modes] lanes, ghost cells too
    void advance(const LocalUnknowns &z, const Vector &step, const Point &trial, double alpha, LocalUnknowns &trial_z) const override;
    std::unique_ptr<Linearisation>      make_linearisation() const override;
    void                                linearise(const Point &point, Linearisation &linearisation) const override;
    std::unique_ptr<SemiDiscreteSystem> implicit_part(const std::string &split) const override;
    Energetics                          energetics(const State &state, Side side) const override;
    std::vector<Vector>                 rigid_motions(const Vector &w) const override;
    std::vector<double>                 events(double t0, double t1) const override;
    std::vector<unsigned int>           canonical_order() const override;

    const Muscle3dParameters     &parameters() const { return parameters_; }          ///< those of the constructor
    const Muscle3dDiscretisation &discretisation() const { return *discretisation_; } ///< mesh, nodes and kernels
    const Loads                  &loads() const { return *loads_; }                   ///< prescribed motions, dead loads, body force
    const SurfaceForces          &surface_forces() const { return *surface_forces_; } ///< forces of supports and loads at faces
    CellSweep                     sweep() const;                                      ///< of the kernels over the body
    /// Along which the body is measured.
    const LineChoice &line_of_action() const { return line_; }
    std::size_t       n_cells() const; ///< on all ranks
    /// Activation at time t, 0 without one.
    Activation activation(double t, Side side = Side::left) const { return parameters_.activation_at(t, side); }

    /// Moves every vertex of the reference mesh by @p map; states and implicit parts made before are void.
    void move_mesh(const std::function<dealii::Point<3>(const dealii::Point<3> &)> &map);

    /// The body as its mesh has it, at rest, without regard to boundary conditions.
    State still_state() const;

    /// Lines for `check`: terms that will be computed and terms that are skipped, each with why.
    std::vector<std::string> plan() const;

  private:
    class Part;

    std::size_t size_of_local() const; ///< doubles of one batch
    /// Position of @p batch of the first rank that has one, for messages.
    std::string where(std::optional<unsigned int> batch) const;

    Muscle3dSystem(Muscle3dParameters parameters, std::shared_ptr<Muscle3dDiscretisation> discretisation, WorkLedger &ledger);

    /// See source/muscle3d/splits.cc.
    std::vector<Split> splits() const;

    Muscle3dParameters                      parameters_;
    LineChoice                              line_;
    WorkLedger                             &ledger_;
    std::shared_ptr<Muscle3dDiscretisation> discretisation_; ///< that of its implicit parts too
    std::unique_ptr<PointMaterials>         materials_;
    std::unique_ptr<SurfaceForces>          surface_forces_;
    std::unique_ptr<Loads>                  loads_;
  };

  /// Sizes of a muscle, estimated from its parameters before anything is made. Numbers, as they may be beyond all integers.
  struct Muscle3dSizes
  {
    double n_cells       = 0; ///< on all ranks
    double n_unknowns    = 0; ///< on all ranks
    double bytes         = 0; ///< on each rank: mesh, batches and the vectors of a run
    double matrix_bytes  = 0; ///< on each rank: the assembled tangent
    double tangent_bytes = 0; ///< on each rank: what actions of the tangent keep at the points
    double patch_bytes   = 0; ///< on each rank: inverses of patches; 0: the system has no two levels
    double coarse_bytes  = 0; ///< on each rank: coarse level, its hierarchy, and the cheaper tangent that goes with it
  };
  Muscle3dSizes estimate_sizes(const Muscle3dParameters &parameters, unsigned int ranks); ///< Those of a run on @p ranks ranks.
} // namespace myolines
