// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/base/registry.h>
#include <myolines/materials/law.h>
#include <myolines/materials/law_kernels.h>
#include <myolines/scene/scene.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  class Law;

  /// A constitutive law that scenes can name: a line of laws/list.def, or one of a plug-in (law_kind.h).
  struct LawKind
  {
    std::string                                                    name;           ///< `type` in a scene
    std::string                                                    doc;            ///< one sentence
    Rates                                                          rates;          ///< what the stress depends on
    bool                                                           has_energy;     ///< whether its struct has `energy`
    bool                                                           hand_tangent;   ///< whether its struct has `tangent`
    bool                                                           stress_at_rest; ///< whether there is a stress at F = I
    scene::Schema                                                  schema;         ///< its parameters
    std::function<std::shared_ptr<const Law>(const scene::Node *)> make;    ///< with the parameters of the node; nullptr: with its defaults
    LawKernelSets                                                  kernels; ///< on batches
  };

  inline const std::string &name_of(const LawKind &kind) { return kind.name; } ///< For Registry.

  /// All laws, in the order of laws/list.def, then those of plug-ins.
  Registry<LawKind> &law_kinds();

  /// A law with its parameters, in plain numbers.
  class Law
  {
  public:
    virtual ~Law() = default;
    /// @p kind outlives the law.
    explicit Law(const LawKind &kind)
      : kind(kind)
    {}

    virtual Mat3<double>          stress(const Strain<double> &s) const = 0; ///< P [Pa]
    virtual std::optional<double> energy(const Strain<double> &s) const = 0; ///< [J/m^3]; nothing where the law has none
    /// w_u dP/dF + w_v dP/dF_rate, [3 a + I][3 b + K] [Pa].
    virtual void        moduli(const Deformation<double> &at, double w_u, double w_v, double (&A)[9][9]) const = 0;
    virtual const void *data() const = 0; ///< the struct, for kernels

    /// Shear modulus at rest [Pa], the mean over all pairs of directions.
    double shear_modulus(const std::array<double, 3> &direction) const;

    const LawKind &kind; ///< what it is one of
  };

  /// A part of a tissue.
  struct TissuePart
  {
    std::string                name;       ///< the scene's
    std::shared_ptr<const Law> law;        ///< with its parameters
    double                     weight = 1; ///< multiplies the stress
  };

  /// Declaration of a list of laws with names of the user's choice, and its reading.
  scene::Schema           laws_schema();
  std::vector<TissuePart> read_laws(const scene::Node &laws); ///< Reads that list, in the order of the scene.
} // namespace myolines
