// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/body/body_fields.h>
#include <myolines/body/entries.h>
#include <myolines/scene/formula.h>

#include <cmath>
#include <limits>

namespace myolines
{
  namespace
  {
    using scene::Node;

    std::string formula_or_none(const Node &node, const std::string &name)
    {
      return node.has(name) ? read_formula(node, name, "volume") : "";
    }

    std::string or_zero(const std::string &text) { return text.empty() ? "0" : text; }
  } // namespace

  scene::Schema fields_schema()
  {
    return scene::Schema(
               "What varies within the body, from formulas of the reference position x, y, z [m] and of volume (the number of the group "
               "of the cell in a mesh, 0 in other bodies), or from a table.")
        .optional_text("maximum isometric stress", "sigma0 of the muscle fibres [Pa], a formula, for example \"2e5*(1-10*x)\".")
        .optional_text("fat fraction", "Fat in the muscle [-], a formula with values in [0, 1], for example \"0.1+2*x\"; the law is that "
                                       "of tissues/muscle/fat or its default.")
        .optional_text("activation scale", "Factor of the activation [-], a formula with values >= 0, for example \"1-5*x\".")
        .optional_text("matrix fraction",
                       "Extracellular matrix in the base material of the muscle [-], a formula with values in [0, 1]; the "
                       "base is that of type \"matrix and cells\".")
        .optional_text("tissue",
                       "Tissue of each point, a formula with values 1 (muscle), 2 (aponeurosis) or 3 (tendon), as in \"x<0.01 ? 2 : 1\"; "
                       "takes the place of the tissues of the cells.")
        .optional_file(
            "table",
            "CSV of points: qp_x, qp_y, qp_z and any of max_iso_stress_muscle, muscle_fibre_orientation_x, _y, _z, "
            "fat_fraction, activation_scale, matrix_fraction, tissue_id; each place takes the nearest row. Or a mesh of VTK with arrays of "
            "these names of its cells or points (muscle_fibre_orientation, or fibre, has three components). Comes after the formulas.")
        .text("table scale", "1", "Unit of the coordinates in the table (m, cm, mm, um), or their factor to metres.");
  }

  BodyFields read_fields(const Node &node)
  {
    BodyFields fields;
    fields.stress           = formula_or_none(node, "maximum isometric stress");
    fields.fat              = formula_or_none(node, "fat fraction");
    fields.activation_scale = formula_or_none(node, "activation scale");
    fields.matrix           = formula_or_none(node, "matrix fraction");
    fields.tissue           = formula_or_none(node, "tissue");
    if (node.has("table"))
      fields.table = std::make_shared<PointProperties>(node.file("table"), read_unit(node, "table scale"));
    return fields;
  }

  /// The formulas, parsed.
  struct MaterialField::Formulas
  {
    VectorFormula                scalars; ///< stress, fat, activation scale
    VectorFormula                others;  ///< fraction of matrix, tissue
    std::optional<VectorFormula> direction;
    std::vector<VectorFormula>   regions;
  };

  MaterialField::MaterialField(const BodyFields &fields, const std::map<unsigned int, TissueParameters> &tissues)
    : fields_(fields)
    , tissues_(tissues)
  {
    if (!fields.formulas())
      return;
    const std::array<std::string, 3> scalars{{or_zero(fields.stress), or_zero(fields.fat), or_zero(fields.activation_scale)}};
    const std::array<std::string, 3> others{{or_zero(fields.matrix), or_zero(fields.tissue), "0"}};
    const char *const                fourth = "volume";
    auto formulas = std::make_shared<Formulas>(Formulas{VectorFormula(scalars, fourth), VectorFormula(others, fourth), {}, {}});
    if (!fields.direction[0].empty())
      formulas->direction.emplace(fields.direction, fourth);
    for (const std::string &region : fields.regions)
      formulas->regions.emplace_back(std::array<std::string, 3>{{region, "0", "0"}}, fourth);
    formulas_ = formulas;
  }

  MaterialField::AtPoint MaterialField::at(const dealii::Point<3> &x, const CellId cell,
                                           const std::optional<std::array<double, 3>> &along) const
  {
    const double volume      = cell.volume;
    unsigned int material_id = cell.tissue;
    std::string  problem;
    if (!fields_.tissue.empty())
      {
        const double id = formulas_->others(1, x, volume), nearest = std::round(id);
        if (std::abs(id - nearest) < 1e-9 && nearest > 0 && tissues_.count(static_cast<unsigned int>(nearest)) > 0)
          material_id = static_cast<unsigned int>(nearest);
        else
          problem = "gives " + std::to_string(id) + " for the tissue";
      }
    TissueParameters tissue           = tissues_.at(material_id);
    double           activation_scale = 1, distance = 0;
    unsigned int     region       = 0;
    const auto       no_direction = [] {
      constexpr double no = std::numeric_limits<double>::quiet_NaN();
      return std::array<double, 3>{{no, no, no}};
    };
    const bool follows = material_id == muscle_id || tissue.fibre.follows_body;
    if (follows && along)
      tissue.fibre.direction = unit_vector(*along).value_or(no_direction());
    if (follows && formulas_ && formulas_->direction)
      {
        const VectorFormula &a = *formulas_->direction;
        tissue.fibre.direction = unit_vector({{a(0, x, volume), a(1, x, volume), a(2, x, volume)}}).value_or(no_direction());
      }
    if (follows && formulas_)
      for (unsigned int r = 0; r < formulas_->regions.size(); ++r)
        {
          const double where = formulas_->regions[r](0, x, volume);
          if (std::isnan(where))
            problem = "the formula of an activation region is not a number";
          if (where > 0)
            region = r + 1;
        }
    if (material_id == muscle_id && formulas_)
      {
        const Formulas &formulas = *formulas_;
        if (!fields_.stress.empty())
          tissue.fibre.sigma0 = formulas.scalars(0, x, volume);
        if (!fields_.fat.empty())
          tissue.fat.fraction = formulas.scalars(1, x, volume);
        if (!fields_.activation_scale.empty())
          activation_scale = formulas.scalars(2, x, volume);
        if (!fields_.matrix.empty())
          tissue.matrix.value().fraction = formulas.others(0, x, volume);
      }
    if (fields_.table)
      {
        const auto [row, away] = fields_.table->nearest(x);
        distance               = away;
        if (row.tissue && *row.tissue != material_id)
          {
            material_id = *row.tissue;
            tissue      = tissues_.at(material_id);
          }
        tissue.fibre.direction = row.direction.value_or(tissue.fibre.direction);
        if (material_id == muscle_id)
          {
            tissue.fibre.sigma0 = row.stress.value_or(tissue.fibre.sigma0);
            tissue.fat.fraction = row.fat.value_or(tissue.fat.fraction);
            activation_scale *= row.activation_scale.value_or(1);
            if (row.matrix)
              tissue.matrix.value().fraction = *row.matrix;
          }
      }
    if (tissue.matrix && !(tissue.matrix->fraction >= 0 && tissue.matrix->fraction <= 1))
      problem = "gives a fraction of extracellular matrix of " + std::to_string(tissue.matrix->fraction);
    Material m = material(tissue);
    m[material_active] *= activation_scale;
    m[material_tissue] = material_id;
    m[material_region] = region;
    return {m, distance, problem};
  }
} // namespace myolines
