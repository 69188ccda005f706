#include <myolines/muscle3d/body_fields.h>

#include <cmath>
#include <stdexcept>

namespace myolines
{
  namespace
  {
    using scene::Node;

    std::string read_formula(const Node &node, const std::string &name)
    {
      if (!node.has(name))
        return "";
      try
        {
          const VectorFormula formula(std::array<std::string, 3>{{node.text(name), "0", "0"}});
        }
      catch (const std::invalid_argument &error)
        {
          node.refuse(name, error.what(), "one expression of x, y, z and pi, e.g. \"2e5*(1+10*x)\"");
        }
      return node.text(name);
    }

    std::string or_zero(const std::string &text) { return text.empty() ? "0" : text; }
  } // namespace

  scene::Schema fields_schema()
  {
    return scene::Schema("What varies within the body, from formulas of the reference position x, y, z [m] or from a table.")
        .optional_text("maximum isometric stress", "sigma0 of the muscle fibres [Pa], a formula.")
        .optional_text("fat fraction",
                       "Fat in the muscle [-], a formula with values in [0, 1]; the law is that of tissues/muscle/fat or its default.")
        .optional_text("activation scale", "Factor of the activation [-], a formula with values >= 0.")
        .optional_file("table", "CSV of points: qp_x, qp_y, qp_z and any of max_iso_stress_muscle, muscle_fibre_orientation_x, _y, _z, "
                                "fat_fraction, activation_scale, tissue_id; each place takes the nearest row. Comes after the formulas.");
  }

  BodyFields read_fields(const Node &node)
  {
    BodyFields fields;
    fields.stress           = read_formula(node, "maximum isometric stress");
    fields.fat              = read_formula(node, "fat fraction");
    fields.activation_scale = read_formula(node, "activation scale");
    if (node.has("table"))
      fields.table = std::make_shared<PointProperties>(node.file("table"));
    return fields;
  }

  MaterialField::MaterialField(const BodyFields &fields, const std::map<unsigned int, TissueParameters> &tissues)
    : fields_(fields)
    , tissues_(tissues)
  {
    if (!fields.direction[0].empty())
      direction_.emplace(fields.direction);
    scalars_.emplace(std::array<std::string, 3>{{or_zero(fields.stress), or_zero(fields.fat), or_zero(fields.activation_scale)}});
  }

  Material MaterialField::at(const dealii::Point<3> &x, unsigned int material_id) const
  {
    TissueParameters tissue           = tissues_.at(material_id);
    double           activation_scale = 1;
    if (material_id == muscle_id)
      {
        if (!fields_.stress.empty())
          tissue.fibre.sigma0 = (*scalars_)(0, x, 0);
        if (!fields_.fat.empty())
          tissue.fat.fraction = (*scalars_)(1, x, 0);
        if (!fields_.activation_scale.empty())
          activation_scale = (*scalars_)(2, x, 0);
        if (direction_)
          {
            double square = 0;
            for (unsigned int c = 0; c < 3; ++c)
              {
                tissue.fibre.direction[c] = (*direction_)(c, x, 0);
                square += tissue.fibre.direction[c] * tissue.fibre.direction[c];
              }
            for (double &a : tissue.fibre.direction)
              a /= std::sqrt(square);
          }
      }
    if (fields_.table)
      material_id = fields_.table->apply(x, tissues_, material_id, tissue, activation_scale);
    Material m = material(tissue);
    m[material_active] *= activation_scale;
    m[material_tissue] = material_id;
    return m;
  }
} // namespace myolines
