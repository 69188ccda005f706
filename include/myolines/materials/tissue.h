// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/materials/laws.h>
#include <myolines/materials/material.h>
#include <myolines/scene/scene.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// Yeoh energy of an isotropic part: Psi(I1) = scale * sum_k c_k (I1 - 3)^k, I1 the isochoric invariant J^(-2/3) tr C.
  /// A neo-Hookean part has c1 alone.
  struct YeohParameters
  {
    double scale = 2e5;                                         ///< s sigma0 [Pa]
    double c[3]  = {0.1990559575103343, 0.3662334826469149, 0}; ///< c_1, c_2, c_3 [-]

    /// C_k = scale c_k [Pa]
    std::array<double, 3> coefficients() const { return {{scale * c[0], scale * c[1], scale * c[2]}}; }
  };

  /// v over its length; nothing if that is zero or not finite.
  std::optional<std::array<double, 3>> unit_vector(const std::array<double, 3> &v);

  /// What fibres do.
  enum class FibreLaw
  {
    muscle, ///< Hill type, sigma = sigma0 (a sA(lam) sV(e) + sP(lam)), thesis (5.2.5)
    tendon  ///< passive, sigma = sigma0 sT(lam), thesis (5.3.5)
  };

  /// What the fibres of a tissue are.
  struct FibreParameters
  {
    FibreLaw              law                 = FibreLaw::muscle; ///< what they do
    double                sigma0              = 2e5;              ///< maximum isometric stress, or the unit of the tendon curve [Pa]
    double                maximum_strain_rate = 5;                ///< e0 [1/s]; muscle
    bool                  force_velocity      = true;             ///< false: sV = 1
    std::array<double, 3> direction{{1, 0, 0}};                   ///< a0 at rest, unit
    bool                  follows_body = true;                    ///< whether the fields of fibre directions of the body are its own
  };

  /// Fat within a tissue, thesis 5.2.3: all other parts weigh 1 - fraction.
  struct FatParameters
  {
    double         fraction     = 0;                   ///< in [0, 1]
    double         bulk_modulus = 1e7;                 ///< [Pa]
    YeohParameters base{1, {323.91, 5163.1, -3872.9}}; ///< c_k [Pa]
  };

  /// Extracellular matrix among the cells, thesis (5.2.12) and (5.2.19): the cells weigh 1 - fraction.
  struct MatrixParameters
  {
    double         fraction     = 0.05; ///< chi_ecm, in [0, 1]
    double         bulk_modulus = 1e7;  ///< [Pa]
    YeohParameters base{1, {0, 0, 0}};  ///< c_k [Pa]
  };

  /// What a tissue is made of.
  struct TissueParameters
  {
    double                          density      = 1060; ///< rho0 [kg/m^3]
    double                          bulk_modulus = 1e7;  ///< kappa [Pa]; of the cells where there is a matrix
    FibreParameters                 fibre;               ///< its fibres
    YeohParameters                  base;                ///< likewise
    std::optional<MatrixParameters> matrix;              ///< none: one base material
    FatParameters                   fat;                 ///< within it
    std::vector<TissuePart>         laws;                ///< that are added to fibre and base

    /// Shear modulus at rest that the laws have together [Pa].
    double shear_modulus_of_laws() const;
    bool   viscous() const; ///< whether some law depends on the rate of strain
  };

  /// A tissue that scenes can name.
  struct TissueKind
  {
    std::string      name;     ///< as scenes have it
    unsigned int     id;       ///< material id of its cells
    std::string      doc;      ///< one sentence
    TissueParameters defaults; ///< as printed in the thesis
  };
  ///@{
  /// Material id of a printed tissue, as in Flexodeal's meshes.
  constexpr unsigned int muscle_id      = 1;
  constexpr unsigned int aponeurosis_id = 2;
  constexpr unsigned int tendon_id      = 3;
  ///@}
  /// Those that are printed in the thesis, muscle first.
  const std::vector<TissueKind> &tissue_kinds();

  /// Names of all tissues of a scene: the printed ones, then those of its own; the material id is the place, from 1.
  using TissueNames = std::vector<std::string>;
  TissueNames  printed_tissues();                                            ///< muscle, aponeurosis, tendon
  unsigned int tissue_id(const TissueNames &names, const std::string &name); ///< 0: none has this name

  using Material = std::array<double, n_material_values>; ///< The numbers of a point, see MaterialValue.

  /// The tissue as a material: fibre parts times 1 - f, base (1 - f) (chi matrix + (1 - chi) base) + f fat and likewise the bulk modulus,
  /// (5.2.3), (5.2.12), (5.2.19) and (5.2.23).
  Material material(const TissueParameters &tissue);

  /// Declaration of the list of a tissue in a scene, and its reading. Directions are the caller's.
  scene::Schema    tissue_schema(const TissueKind &kind);
  TissueParameters read_tissue(const TissueKind &kind, const scene::Node &node); ///< Reads that list. @throws InputError

  /// The same of a tissue of the scene's own, which is the sum of its laws.
  scene::Schema    own_tissue_schema();
  TissueParameters read_own_tissue(const scene::Node &node); ///< Reads that list. @throws InputError
} // namespace myolines
