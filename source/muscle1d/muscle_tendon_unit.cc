#include <myolines/muscle1d/gait.h>
#include <myolines/muscle1d/muscle_tendon_unit.h>
#include <myolines/muscle1d/sampled.h>

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

      Schema file("Samples in a file of comma-separated values with names in its first line, at ascending times.");
      file.file("file", "Samples of length and excitation.")
          .text("time column", "Time [s]", "Name of the column of times [s].")
          .text("length column", "length [m]", "Name of the column of lengths of muscle and tendon [m], before scaling.")
          .optional_file("excitation file", "Samples of the excitation, where they are in a file of their own with the same time column.")
          .text("excitation column", "excitation", "Name of the column of excitations, from 0 to 1.")
          .choice("interpolation", "spline", {"spline", "linear"},
                  "A natural cubic spline, or straight lines, whose every sample is a kink (\"time/events\").")
          .optional_number("cut-off frequency", "Hz", Range::positive(),
                           "The spline smooths: oscillations of this frequency are halved, faster ones vanish; where not written it "
                           "passes through all samples.");
      Schema schema("Length of muscle and tendon, and excitation.");
      schema.variant("type", "synthetic", {{"synthetic", synthetic}, {"file", file}}, "Where they come from.");
      return schema;
    }

    struct Input
    {
      std::shared_ptr<const Drive> length; ///< before scaling [m]
      std::shared_ptr<const Drive> excitation;
      double                       begin = 0; ///< [s]
      double                       end   = std::numeric_limits<double>::infinity();
    };

    std::shared_ptr<const SampledDrive> sampled(const Node &node, const Samples &samples, const double factor)
    {
      const std::string   choice = "interpolation", cut_off = "cut-off frequency";
      std::vector<double> x = samples.x.front();
      for (double &value : x)
        value *= factor;
      if (node.text(choice) == "spline")
        return std::make_shared<SampledDrive>(
            SampledDrive::spline(samples.t, x, node.has(cut_off) ? node.number(cut_off) : std::numeric_limits<double>::infinity()));
      if (node.has(cut_off))
        node.refuse(cut_off, "straight lines do not smooth", "\"interpolation\" = \"spline\", or no cut-off frequency");
      return std::make_shared<SampledDrive>(SampledDrive::lines(samples.t, x));
    }

    Input read_input(const Node &input, const double unit_length, const double scale)
    {
      if (input.text("type") == "synthetic")
        return {
            std::make_shared<GaitLength>(scale * unit_length, input.number("base"), input.number("amplitude"), input.number("frequency")),
            std::make_shared<GaitExcitation>(input.number("frequency"))};
      const std::string time       = input.text("time column");
      const Samples     length     = read_samples(input.file("file"), time, {input.text("length column")});
      const Samples     excitation = read_samples(input.has("excitation file") ? input.file("excitation file") : input.file("file"), time,
                                              {input.text("excitation column")});
      for (const double x : length.x.front())
        if (!(x > 0))
          input.refuse("length column", "there is a length of " + std::to_string(x) + " m", "lengths > 0 [m]");
      for (const double x : excitation.x.front())
        if (x < 0 || x > 1)
          input.refuse("excitation column", "there is an excitation of " + std::to_string(x), "numbers from 0 to 1");
      if (std::max(length.t.front(), excitation.t.front()) > 0)
        input.refuse("file", "the samples begin after the time 0", "samples at 0 s or before");
      return {sampled(input, length, scale), sampled(input, excitation, 1), 0, std::min(length.t.back(), excitation.t.back())};
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
      p.input_end                 = input.end;
      p.tendon                    = Tendon{optimal.tendon, input.length};
      if (system.text("activation") == "beforehand")
        p.activation = std::make_shared<ZajacActivation>(data.zajac, input.excitation);

      const double L    = input.length->value(0, Side::right);
      const double a    = system.text("initial balance") == "active" ? data.zajac.steady(input.excitation->value(0, Side::right)) : 0;
      p.initial_stretch = balanced_length(optimal, L, a, L * data.length_ratio) / optimal.muscle;
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
