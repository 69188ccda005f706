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
    std::string                                                    name, doc;
    Rates                                                          rates;
    bool                                                           has_energy, hand_tangent, stress_at_rest;
    scene::Schema                                                  schema; ///< its parameters
    std::function<std::shared_ptr<const Law>(const scene::Node *)> make;   ///< with the parameters of the node; nullptr: with its defaults
    LawKernelSets                                                  kernels;
  };

  inline const std::string &name_of(const LawKind &kind) { return kind.name; }

  /// All laws, in the order of laws/list.def, then those of plug-ins.
  Registry<LawKind> &law_kinds();

  /// A law with its parameters, in plain numbers.
  class Law
  {
  public:
    virtual ~Law() = default;
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

    const LawKind &kind;
  };

  /// A part of a tissue.
  struct TissuePart
  {
    std::string                name; ///< the scene's
    std::shared_ptr<const Law> law;
    double                     weight = 1;
  };

  /// Declaration of a list of laws with names of the user's choice, and its reading.
  scene::Schema           laws_schema();
  std::vector<TissuePart> read_laws(const scene::Node &laws);
} // namespace myolines
