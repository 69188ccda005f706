// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/body/cell_id.h>
#include <myolines/materials/tissue.h>
#include <myolines/scene/scene.h>

#include <deal.II/base/point.h>

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace myolines
{
  /// Properties of the body, read from a file. Their names are those of the complete Flexodeal: max_iso_stress_muscle [Pa],
  /// muscle_fibre_orientation, fat_fraction, activation_scale, matrix_fraction (one of our own), tissue_id (1 muscle, 2 aponeurosis, 3
  /// tendon).
  /// - A CSV file has columns by name, in any order: qp_x, qp_y, qp_z and any of these (muscle_fibre_orientation_x, _y, _z). A first
  ///   column without a name, as programs write it that number rows, is passed over. Units in brackets are converted. Each place of the
  ///   body takes the nearest row.
  /// - A mesh in a format of VTK has them as arrays; that of the fibre orientation has three components and may be called fibre as well.
  ///   Each place takes what its cell has, or between the points of the cell what they have, linearly; vectors of points are turned to
  ///   the same side before. Vectors of length zero say nothing. Other arrays are passed over.
  class PointProperties
  {
  public:
    /// @p scale: metres per unit of the coordinates in the file. @throws InputError for a file that cannot be read, columns that are
    /// unknown or incomplete, and values out of range.
    explicit PointProperties(const std::filesystem::path &file, double scale = 1);
    ~PointProperties();

    /// What the file knows of a place; nothing where it has no such column.
    struct Row
    {
      std::optional<double>                stress;           ///< maximum isometric stress [Pa]
      std::optional<double>                fat;              ///< fraction, 0 to 1
      std::optional<double>                activation_scale; ///< factor of the activation
      std::optional<double>                matrix;           ///< fraction of extracellular matrix, 0 to 1
      std::optional<std::array<double, 3>> direction;        ///< unit
      std::optional<unsigned int>          tissue;           ///< material id
    };
    /// What the file has for @p x, and how far from there [m].
    std::pair<Row, double> nearest(const dealii::Point<3> &x) const;
    bool                   has_fat() const;        ///< whether it has fractions of fat
    bool                   has_matrix() const;     ///< whether it has fractions of extracellular matrix
    bool                   has_directions() const; ///< of fibres
    /// The tissues that it names.
    const std::vector<unsigned int> &tissues() const;
    const std::filesystem::path     &file() const;   ///< where they come from
    double                           extent() const; ///< diagonal of the box around its points [m]

    /// How the file keeps its rows.
    class Source;

  private:
    std::unique_ptr<const Source> source_;
  };

  /// Fibres along the gradient of a potential that is 0 on one face and 1 on another.
  struct FibresBetweenFaces
  {
    unsigned int from; ///< boundary id of the face where the potential is 0
    unsigned int to;   ///< of that where it is 1
  };

  /// What varies within the body: formulas of x, y, z and volume, of the tissue and then for muscle, and a table for all tissues, which
  /// comes last.
  struct BodyFields
  {
    std::string                            stress;           ///< maximum isometric stress [Pa]; "": that of the tissue
    std::string                            fat;              ///< fat fraction; likewise
    std::string                            activation_scale; ///< factor of the activation; "": 1
    std::string                            matrix;           ///< fraction of extracellular matrix; "": that of the tissue
    std::string                            tissue;           ///< material id of the tissue; "": that of the cell
    std::array<std::string, 3>             direction;        ///< fibre direction, to be normalised; "": that of the tissue
    std::vector<std::string>               regions; ///< of activation: places where the formula is positive; later ones cover earlier
    std::optional<FibresBetweenFaces>      laplace; ///< fibres along the gradient of a potential
    std::shared_ptr<const PointProperties> table;   ///< properties from a file

    /// Whether there is any formula.
    bool formulas() const
    {
      return !stress.empty() || !fat.empty() || !activation_scale.empty() || !matrix.empty() || !tissue.empty() || !direction[0].empty() ||
             !regions.empty();
    }
    /// Whether the muscle differs from place to place, table aside.
    bool within_muscle() const { return formulas() || laplace; }
    /// Whether any tissue may differ from place to place.
    bool of_all_tissues() const { return table || !tissue.empty(); }
    bool any() const { return within_muscle() || table; }                                 ///< Whether anything varies.
    bool has_fat() const { return !fat.empty() || (table && table->has_fat()); }          ///< Whether there may be fat.
    bool has_matrix() const { return !matrix.empty() || (table && table->has_matrix()); } ///< Whether there may be extracellular matrix.
  };

  /// Declaration of the list `fields`, and its reading (without directions).
  scene::Schema fields_schema();
  BodyFields    read_fields(const scene::Node &node); ///< Reads that list.

  /// The material at points of a body with fields.
  class MaterialField
  {
  public:
    /// Borrows both. @throws InputError for formulas that cannot be read.
    MaterialField(const BodyFields &fields, const std::map<unsigned int, TissueParameters> &tissues);

    /// What the fields make of a point.
    struct AtPoint
    {
      Material    material; ///< see MaterialValue
      double      distance; ///< to the row of the table [m]; 0 without one
      std::string problem;  ///< what the fields get wrong there, where the material does not tell; else empty
    };
    /// @p along: direction of the muscle fibres that the potential gives, any length.
    AtPoint at(const dealii::Point<3> &x, CellId cell, const std::optional<std::array<double, 3>> &along) const;

  private:
    struct Formulas;

    const BodyFields                               &fields_;
    const std::map<unsigned int, TissueParameters> &tissues_;
    std::shared_ptr<const Formulas>                 formulas_; ///< none if there are none
  };
} // namespace myolines
