// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/muscle1d/gait.h>
#include <myolines/muscle1d/muscle_tendon_unit.h>
#include <myolines/scene/numbers.h>
#include <myolines/system/file_drive.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace myolines
{
  namespace
  {
    using scene::Node;
    using scene::Range;
    using scene::Schema;

    /// What replaces values of Table 2.1.
    Schema data_schema()
    {
      Schema schema("Values that replace those of thesis Table 2.1; what is not written is as there.");
      schema.optional_number("maximum stress", "Pa", Range::positive(), "sigma_0; 225 kPa.")
          .optional_number("maximum strain rate", "1/s", Range::positive(), "e_0, of the unloaded muscle; 5, cycling 10.")
          .optional_number("activation time", "s", Range::positive(), "tau of Zajac's equation; 0.045, cycling 0.025.")
          .optional_number("deactivation ratio", "-", Range{0, 1, true, false}, "beta: tau over the time of deactivation; 0.6.")
          .optional_number("volume fraction", "-", Range{0, 1, true, false}, "chi_M, of one lower leg; MG 0.0362, VM 0.0606, ST 0.026.")
          .optional_number("length ratio", "-", Range{0, 1, true, true}, "r_M, of muscle to muscle and tendon; MG 0.54, VM 0.84, ST 0.70.")
          .optional_number("optimal unit length", "m", Range::positive(), "Of muscle and tendon; see Table 2.1.")
          .optional_number("density", "kg/m^3", Range::positive(), "rho_0; 1060.")
          .optional_number("body mass", "kg", Range::positive(), "W in the volume chi_M (47 W H + 1285) 1e-6 m^3; 68.")
          .optional_number("body height", "m", Range::positive(), "H; 1.67.")
          .optional_number("volume", "m^3", Range::positive(), "Of the muscle, instead of that formula.");
      return schema;
    }

    MuscleData read_data(const Node &system)
    {
      MuscleData  data   = MuscleData::table21(system.text("muscle"), system.text("task"));
      const Node &values = system.section("data");
      const auto  take   = [&](const std::string &name, double &value) {
        if (values.has(name))
          value = values.number(name);
      };
      take("maximum stress", data.maximum_stress);
      take("maximum strain rate", data.maximum_strain_rate);
      take("activation time", data.zajac.time_constant);
      take("deactivation ratio", data.zajac.ratio);
      take("volume fraction", data.volume_fraction);
      take("length ratio", data.length_ratio);
      take("optimal unit length", data.unit_length);
      take("density", data.density);
      take("body mass", data.body_mass);
      take("body height", data.body_height);
      return data;
    }

    Schema input_schema()
    {
      Schema synthetic("A gait in closed form: L/L_opt = base + amplitude (0.045 (1 - cos 2 pi f t)/2 + 0.015 (1 - cos 4 pi f t)/2), "
                       "excitation 0.02 and two bursts per cycle.");
      synthetic.number("base", 0.98, "-", Range::positive(), "Smallest length of muscle and tendon over the optimal one.")
          .number("amplitude", 1, "-", Range::not_negative(), "Of the motion.")
          .number("frequency", 1.4, "Hz", Range::positive(), "f.");

      Schema file("Samples of both in tables under names, at ascending times (doc/data.md).");
      file.file("file", "Samples of length and excitation.")
          .text("time column", "Time [s]", "Name of the column of times.")
          .text("length column", "length [m]", "Name of the column of lengths of muscle and tendon, before scaling; [m] if it has no unit.")
          .optional_file("excitation file", "Samples of the excitation, where they are in a file of their own with the same time column.")
          .text("excitation column", "excitation", "Name of the column of excitations, from 0 to 1.")
          .choice("interpolation", "spline", {"spline", "linear"},
                  "A cubic spline, monotone where the excitation would leave 0 to 1, or straight lines, whose every sample is a kink.")
          .optional_number("cut-off frequency", "Hz", Range::positive(), "Oscillations of this frequency are halved, faster ones vanish.");
      Schema profiles("Each a function of time of its own.");
      profiles.section("length", drive_schema("length of muscle and tendon, after scaling", "m"))
          .section("excitation", drive_schema("excitation", "-"));
      Schema schema("Length of muscle and tendon, and excitation.");
      schema.variant("type", "synthetic", {{"synthetic", synthetic}, {"file", file}, {"profiles", profiles}}, "Where they come from.");
      return schema;
    }

    struct Input
    {
      std::shared_ptr<const Drive> length; ///< after scaling [m]
      std::shared_ptr<const Drive> excitation;
    };

    const Driven driven_length{"length", "m"}, driven_excitation{"excitation", "-", Range::closed(0, 1)};

    /// The column that the parameter @p column names.
    std::shared_ptr<const FileDrive> sampled(const Node &node, const std::string &file, const std::string &column, const Driven &driven,
                                             const double factor)
    {
      FileProfile profile{node.where(column), {node.file(file), node.text("time column"), node.text(column), ""}};
      if (node.has("cut-off frequency"))
        profile.low_pass = node.number("cut-off frequency");
      profile.scale = factor;
      profile.lines = node.text("interpolation") == "linear";
      return std::make_shared<FileDrive>(profile, driven);
    }

    /// Lengths in another unit are far from the optimal one.
    void refuse_length(const Node &input, const std::string &parameter, const double length, const double optimal)
    {
      if (!(length > 0.2 * optimal && length < 5 * optimal))
        input.refuse(parameter,
                     "there is a length of " + scene::format_number(length) + " m, " + scene::format_number(length / optimal) +
                         " times the optimal length of muscle and tendon",
                     "lengths [m] from 0.2 to 5 times the optimal one, " + scene::format_number(optimal) + " m",
                     "millimetres? Then write the unit into the name of the column: \"length [mm]\"");
    }

    Input read_input(const Node &input, const double unit_length, const double scale)
    {
      const double      optimal = scale * unit_length;
      const std::string type    = input.text("type");
      if (type == "synthetic")
        {
          refuse_length(input, "base", input.number("base") * optimal, optimal);
          return {std::make_shared<GaitLength>(optimal, input.number("base"), input.number("amplitude"), input.number("frequency")),
                  std::make_shared<GaitExcitation>(input.number("frequency"))};
        }
      Input read;
      if (type == "file")
        read = {sampled(input, "file", "length column", driven_length, scale),
                sampled(input, input.has("excitation file") ? "excitation file" : "file", "excitation column", driven_excitation, 1)};
      else
        read = {make_drive(input.section("length"), driven_length), make_drive(input.section("excitation"), driven_excitation)};
      const std::string named = type == "file" ? "length column" : "length";
      if (const FileDrive *file = file_of(read.length.get()))
        {
          refuse_length(input, named, file->extremes().least, optimal);
          refuse_length(input, named, file->extremes().greatest, optimal);
        }
      else
        refuse_length(input, named, read.length->value(0, Side::right), optimal);
      return read;
    }

    /// The time nearest to 0 s at which both are known.
    double reference_time(const Input &input)
    {
      double t = 0;
      for (const Drive *drive : {input.length.get(), input.excitation.get()})
        if (const FileDrive *file = file_of(drive))
          t = std::clamp(t, file->begin(), file->end());
      return t;
    }

    /// What both kinds of muscles with tendons share.
    Schema with_common(const std::string &doc)
    {
      Schema schema(doc);
      schema.choice("muscle", "ST", {"MG", "VM", "ST"}, "Medial gastrocnemius, vastus medialis or semitendinosus, thesis Table 2.1.")
          .choice("task", "running", {"walking", "running", "cycling"}, "Of the same table.")
          .section("data", data_schema())
          .number("scale", 1, "-", Range::positive(), "s: lengths grow by s, forces by s^2, masses by s^3, thesis 2.2.6.")
          .section("input", input_schema())
          .choice(
              "activation", "beforehand", {"beforehand", "unknown"},
              "Zajac's equation (2.2.5) is integrated beforehand, or solved with the motion, as an unknown of first order of each element.")
          .choice("initial balance", "active", {"active", "passive"},
                  "At the start muscle and tendon balance with the activation of that moment, or without any as in the thesis (errata 3).")
          .number("damping", 0, "-", Range::not_negative(), "eta: the force eta F_0 e beside the muscle's, e the strain rate over e_0.");
      return schema;
    }

    double initial_stretch(const Muscle1dParameters &p, const OptimalLengths &optimal, const double t, const Node &system)
    {
      try
        {
          return p.balanced_stretch(t);
        }
      catch (const SolveError &)
        {
          const auto metres = [](const double length) { return scene::format_number(length) + " m"; };
          throw InputError(InputProblem{system.where("input"),
                                        "in a unit of " + metres(p.tendon->unit_length->value(t, Side::right)) +
                                            ", its length at the start, muscle and tendon balance at no length of the muscle",
                                        "a length that gives the muscle 0.4 to 1.7 of its optimal length, " + metres(optimal.muscle) +
                                            ", beside a tendon of " + metres(optimal.tendon),
                                        "the lengths of \"data\" and \"scale\" belong to those of \"input\""});
        }
    }

    Muscle1dParameters read_common(const Node &system)
    {
      const MuscleData     data    = read_data(system);
      const double         scale   = system.number("scale");
      const OptimalLengths optimal = calibrate(scale * data.unit_length, data.length_ratio);
      const Input          input   = read_input(system.section("input"), data.unit_length, scale);
      const double         volume =
          std::pow(scale, 3) * (system.section("data").has("volume") ? system.section("data").number("volume") : data.volume());

      Muscle1dParameters p;
      p.optimal_length            = optimal.muscle;
      p.maximum_force             = data.maximum_stress * volume / optimal.muscle;
      p.mass                      = data.density * volume;
      p.force.maximum_strain_rate = data.maximum_strain_rate;
      p.force.damping             = system.number("damping");
      p.excitation                = input.excitation;
      p.zajac                     = data.zajac;
      p.tendon                    = Tendon{optimal.tendon, input.length};
      if (system.text("activation") == "beforehand")
        p.activation = std::make_shared<ZajacActivation>(data.zajac, input.excitation);

      const bool active  = system.text("initial balance") == "active";
      p.balanced_stretch = [=, drive = p.activation, ratio = data.length_ratio, zajac = data.zajac](const double t) {
        const double L = input.length->value(t, Side::right);
        const double a = !active            ? 0
                         : drive != nullptr ? drive->value(t, Side::right)
                                            : zajac.steady(input.excitation->value(t, Side::right));
        return balanced_length(optimal, L, a, L * ratio) / optimal.muscle;
      };
      p.initial_stretch = initial_stretch(p, optimal, reference_time(input), system);
      return p;
    }
  } // namespace

  scene::Schema muscle_tendon_unit_schema()
  {
    Schema schema =
        with_common("Muscle of N equal masses between Hill springs, with a tendon, the length of both given; thesis chapter 2.");
    schema.integer("masses", 16, Range::closed(0, 10000000), "N; 0: the massless muscle-tendon unit (2.2.6).");
    return schema;
  }

  Muscle1dParameters read_muscle_tendon_unit(const Node &system)
  {
    Muscle1dParameters p = read_common(system);
    const unsigned int n = system.integer("masses");
    p.n_elements         = std::max(n, 1u);
    p.mass_of            = n == 0 ? MassOf::none : MassOf::points;
    return p;
  }

  scene::Schema continuum_muscle_schema()
  {
    Schema schema = with_common("Muscle as a continuum, thesis (3.3.6), by finite elements, with a tendon, the length of both given.");
    schema.integer("elements", 60, Range::closed(1, 10000000), "Number of elements.")
        .number("grading", 0.2, "-", Range::closed(1e-3, 1e3),
                "Length of the last element, at the tendon, over that of the first; in between a geometric series. The tendon pulls fronts "
                "out of the end of the muscle, which smaller elements there resolve.")
        .integer("degree", 1, Range::closed(1, 16),
                 "Polynomial degree of the elements; where force-velocity damps nothing, fronts are steep and higher ones no better.")
        .choice(
            "mass", "blended", {"lumped", "blended", "consistent"},
            "Integrated on the nodes, exactly, or a third exactly and the rest on the nodes. Where force-velocity damps nothing, elements "
            "with consistent mass, the more the farther, and of higher degree have another limit than many masses.")
        .number(
            "front viscosity", 1, "-", Range::not_negative(),
            "b: the artificial viscosity b Re (h/l_M)^2 (|e| - 8)^2 where the strain rate e is beyond 8 and force-velocity damps nothing, "
            "Re the musculoskeletal Reynolds number and h the distance of nodes; elsewhere zero, as it is in the limit of many elements.")
        .number("base material fraction", 0, "-", Range{0, 1, false, true}, "chi_BM of (3.3.11).")
        .section("base material", base_material_schema());
    return schema;
  }

  Muscle1dParameters read_continuum_muscle(const Node &system)
  {
    Muscle1dParameters                  p = read_common(system);
    const std::map<std::string, MassOf> masses{
        {"lumped", MassOf::lumped}, {"blended", MassOf::blended}, {"consistent", MassOf::consistent}};
    p.n_elements      = system.integer("elements");
    p.grading         = system.number("grading");
    p.degree          = system.integer("degree");
    p.mass_of         = masses.at(system.text("mass"));
    p.force.base      = read_base_material(system);
    p.front_viscosity = system.number("front viscosity");
    return p;
  }
} // namespace myolines
