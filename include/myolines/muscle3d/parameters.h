// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/body/body_fields.h>
#include <myolines/body/initial_motion.h>
#include <myolines/boundary/boundary.h>
#include <myolines/boundary/line_of_action.h>
#include <myolines/kernels/kernels.h>
#include <myolines/materials/curve_set.h>
#include <myolines/materials/tissue.h>
#include <myolines/materials/volume_energy.h>
#include <myolines/scene/scene.h>
#include <myolines/system/drive.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// A part of the body with an activation of its own.
  struct ActivationRegion
  {
    std::string                  name;       ///< that the scene gives it
    std::shared_ptr<const Drive> activation; ///< nullptr: none
  };

  /// A law of a tissue as a part of the body.
  struct LawPart
  {
    unsigned int      tissue; ///< material id
    const TissuePart *part;   ///< borrowed
    std::string       name;   ///< of tissue and part: "myocardium wall"
  };

  /// What Muscle3dSystem is made of: the list `system` of a scene, read.
  struct Muscle3dParameters
  {
    bool                                      dynamic       = true; ///< with inertia and rates; false: quasi-static
    bool                                      exact_tangent = true; ///< false: its symmetric part, where force-velocity makes another
    RateTangent                               rate_tangent;         ///< of the force-velocity relation
    unsigned int                              degree   = 2;         ///< of the displacement, 1..3
    unsigned int                              n_points = 4;         ///< Gauss points per direction, 2..6
    Geometry                                  geometry;             ///< the reference body
    TissueNames                               tissue_names = printed_tissues(); ///< of all that there could be
    std::map<unsigned int, TissueParameters>  tissues{{muscle_id, {}}};         ///< of the cells, by material id; the muscle in any case
    bool                                      has_muscle = true;                ///< whether the body has any
    std::optional<double>                     pennation_angle;                  ///< of the fibres, where the scene gives it so [degree]
    BodyFields                                fields;                           ///< what varies within the body
    BoundaryConditions                        boundary;                         ///< in the order of the scene
    InitialMotion                             initial;                          ///< displacement and velocity at the start
    LineGiven                                 line;                             ///< of action, what the scene says of it
    VolumeForm                                volume_form = VolumeForm::thesis; ///< of the volumetric energy of all tissues
    std::shared_ptr<const CurveSet>           curves;                           ///< nullptr: those of the thesis
    std::shared_ptr<const Drive>              activation;                       ///< of all but the regions; nullptr: none
    std::vector<ActivationRegion>             regions;                          ///< at most max_regions - 1, places in fields.regions
    std::optional<std::array<std::string, 3>> body_force;                       ///< per reference volume [N/m^3], formulas of x, y, z, t

    /// Of all tissues, one behind the other.
    std::vector<LawPart> law_parts() const;
    std::size_t          first_law(unsigned int material_id) const;        ///< place in law_parts() of the first law of a tissue
    bool                 any_laws() const { return !law_parts().empty(); } ///< whether law_parts() is not empty

    /// of a material id that cells have
    const TissueParameters &tissue(const unsigned int material_id) const { return tissues.at(material_id); }
    ///@{
    /// The muscle tissue.
    TissueParameters       &muscle() { return tissues.at(muscle_id); }
    const TissueParameters &muscle() const { return tissues.at(muscle_id); }
    ///@}
    /// Whether there may be active stress at some time, whether it depends on the strain rate, and whether laws of tissues do.
    bool active() const;
    bool force_velocity() const
    {
      return dynamic && active() && muscle().fibre.force_velocity;
    }                     ///< Whether active stress depends on the strain rate.
    bool viscous() const; ///< Whether some law depends on the rate of strain.
    /// At time t.
    Activation activation_at(double t, Side side) const;
    /// All drives of the activation.
    std::vector<const Drive *> activation_drives() const;
    /// as kernels take them; borrowed from this object
    curves::FibreCurves fibre_curves() const { return curves ? curves->view() : curves::FibreCurves{}; }
    /// Whether there may be fat somewhere.
    bool has_fat() const { return muscle().fat.fraction != 0 || fields.has_fat(); }
    /// Length at rest of the longest straight fibre of a block or the idealised gastrocnemius [m], the L_f0 of thesis (7.2.1).
    double fibre_length() const;
  };

  /// Declaration of the list `system` for type "muscle 3d".
  scene::Schema muscle3d_schema();

  /// Of the list `tissues`: the printed tissues, then the scene's own.
  TissueNames read_tissue_names(const scene::Node &tissues);

  /// @throws InputError for what ranges cannot express (unknown face or component, a direction of length zero, two
  /// conditions that prescribe the same component of the same face, malformed formulas).
  Muscle3dParameters read_muscle3d(const scene::Node &system);
} // namespace myolines
