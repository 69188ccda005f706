#pragma once

#include <myolines/materials/tissue.h>
#include <myolines/muscle3d/formula.h>
#include <myolines/scene/scene.h>

#include <deal.II/base/point.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace myolines
{
  /// Properties at points of the body, read from a CSV file as the complete Flexodeal writes and reads them. Columns by name, in
  /// any order: qp_x, qp_y, qp_z [m], and any of max_iso_stress_muscle [Pa], muscle_fibre_orientation_x, _y, _z, fat_fraction,
  /// activation_scale, tissue_id (1 muscle, 2 aponeurosis, 3 tendon). Each place of the body takes the nearest row.
  class PointProperties
  {
  public:
    /// @throws InputError for a file that cannot be read, columns that are unknown or incomplete, and values out of range.
    explicit PointProperties(const std::filesystem::path &file);
    ~PointProperties();

    /// Changes what the file knows of the tissue at @p x; returns the material id there.
    unsigned int apply(const dealii::Point<3> &x, const std::map<unsigned int, TissueParameters> &tissues, unsigned int material_id,
                       TissueParameters &tissue, double &activation_scale) const;
    /// Distance from @p x to the nearest row [m].
    double distance(const dealii::Point<3> &x) const;
    bool   has_fat() const;
    /// The tissues that it names.
    const std::vector<unsigned int> &tissues() const;
    const std::filesystem::path     &file() const;

  private:
    struct Table;
    std::unique_ptr<Table> table_;
  };

  /// What varies within the body: formulas of x, y, z for muscle, and a table for all tissues, which comes last.
  struct BodyFields
  {
    std::string                            stress;           ///< maximum isometric stress [Pa]; "": that of the tissue
    std::string                            fat;              ///< fat fraction; likewise
    std::string                            activation_scale; ///< factor of the activation; "": 1
    std::array<std::string, 3>             direction;        ///< fibre direction, to be normalised; "": that of the tissue
    std::shared_ptr<const PointProperties> table;

    bool formulas() const { return !stress.empty() || !fat.empty() || !activation_scale.empty() || !direction[0].empty(); }
    bool any() const { return formulas() || table; }
    bool has_fat() const { return !fat.empty() || (table && table->has_fat()); }
  };

  /// Declaration of the list `fields`, and its reading (without directions).
  scene::Schema fields_schema();
  BodyFields    read_fields(const scene::Node &node);

  /// The material at points of a body with fields.
  class MaterialField
  {
  public:
    MaterialField(const BodyFields &fields, const std::map<unsigned int, TissueParameters> &tissues);
    Material at(const dealii::Point<3> &x, unsigned int material_id) const;

  private:
    const BodyFields                               &fields_;
    const std::map<unsigned int, TissueParameters> &tissues_;
    std::optional<VectorFormula>                    direction_, scalars_;
  };
} // namespace myolines
