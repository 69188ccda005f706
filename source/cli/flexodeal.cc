#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/cli/catalogue.h>
#include <myolines/cli/flexodeal.h>
#include <myolines/cli/prm_file.h>
#include <myolines/muscle3d/plausibility.h>
#include <myolines/output/text_file.h>
#include <myolines/scene/input_text.h>
#include <myolines/scene/numbers.h>
#include <myolines/time/step_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    using scene::format_number;
    using scene::parse_number;
    using Settings = std::vector<scene::Setting>;

    /// An entry of the peer's file: where it goes, or why it goes nowhere.
    struct Rule
    {
      const char *section;
      const char *name;
      const char *path = ""; ///< of the parameter that takes the text as it is; "" if it is handled by itself
      const char *lost = ""; ///< why it has no counterpart
    };

    const char *const own_solver   = "the solvers here have settings of their own";
    const char *const other_output = "outputs are chosen in the list \"output\"";

    const std::vector<Rule> common_rules{
        {"Finite element system", "Polynomial degree", "system/discretisation/degree"},
        {"Finite element system", "Quadrature order", "system/discretisation/quadrature points"},
        {"Finite element system", "Type of simulation", "system/inertia"},
        {"Geometry", "Global refinement"},
        {"Geometry", "Grid scale"},
        {"Geometry", "Pressure ratio p/p0", "", "imported scenes have no pressure load"},
        {"Linear solver", "Max iteration multiplier", "", own_solver},
        {"Linear solver", "Residual", "", own_solver},
        {"Linear solver", "Use static condensation", "", "pressure and dilatation are always eliminated"},
        {"Linear solver", "Preconditioner type", "", own_solver},
        {"Linear solver", "Preconditioner relaxation", "", own_solver},
        {"Linear solver", "Solver type", "", own_solver},
        {"Materials", "Muscle density", "system/tissues/muscle/density"},
        {"Materials", "Sigma naught muscle", "system/tissues/muscle/fibre/maximum isometric stress"},
        {"Materials", "Bulk modulus muscle", "system/tissues/muscle/bulk modulus"},
        {"Materials", "Max strain rate", "system/tissues/muscle/fibre/maximum strain rate"},
        {"Materials", "Sigma naught base material", "system/tissues/muscle/base/stress scale"},
        {"Materials", "Muscle base material factor", "system/tissues/muscle/base/factor"},
        {"Materials", "Muscle base material constant 1", "system/tissues/muscle/base/c1"},
        {"Materials", "Muscle base material constant 2", "system/tissues/muscle/base/c2"},
        {"Materials", "Muscle base material constant 3", "system/tissues/muscle/base/c3"},
        {"Nonlinear solver", "Nonlinear solver type", "", own_solver},
        {"Nonlinear solver", "Max iterations Newton-Raphson", "solver/nonlinear/maximum iterations"},
        {"Nonlinear solver", "Tolerance displacement", "", "convergence is judged by the residual"},
        {"Nonlinear solver", "Tolerance force", "solver/nonlinear/absolute tolerance"},
        {"Time", "End time"},
        {"Time", "Time step size"},
        {"Prescribed displacement", "Pulling face ID"},
        {"Measuring locations", "Markers list file"},
        {"Output binary files", "Output binary files main variables", "", other_output},
        {"Output binary files", "Output binary files tensors", "", other_output},
    };

    /// Flexodeal Lite: a block of muscle with one fibre direction.
    const std::vector<Rule> lite_rules{
        {"Geometry", "Length"},
        {"Geometry", "Width"},
        {"Geometry", "Height"},
        {"Materials", "Muscle x component", "system/fibres/x"},
        {"Materials", "Muscle y component", "system/fibres/y"},
        {"Materials", "Muscle z component", "system/fibres/z"},
    };

    const char *const no_tendon = "the idealised gastrocnemius has no cells of tendon";

    /// Flexodeal: the idealised gastrocnemius with aponeurosis and fat.
    const std::vector<Rule> full_rules{
        {"Geometry", "Muscle length"},
        {"Geometry", "Aponeurosis length"},
        {"Geometry", "Aponeurosis height"},
        {"Geometry", "Muscle width"},
        {"Geometry", "Pennation angle", "system/geometry/pennation angle"},
        {"Materials", "Sigma naught aponeurosis", "system/tissues/aponeurosis/fibre/stress scale"},
        {"Materials", "Bulk modulus aponeurosis", "system/tissues/aponeurosis/bulk modulus"},
        {"Materials", "Sigma naught aponeurosis base material", "system/tissues/aponeurosis/base/stress scale"},
        {"Materials", "Aponeurosis base material factor", "system/tissues/aponeurosis/base/factor"},
        {"Materials", "Aponeurosis base material constant 1", "system/tissues/aponeurosis/base/c1"},
        {"Materials", "Aponeurosis base material constant 2", "system/tissues/aponeurosis/base/c2"},
        {"Materials", "Aponeurosis base material constant 3", "system/tissues/aponeurosis/base/c3"},
        {"Materials", "Sigma naught tendon", "", no_tendon},
        {"Materials", "Bulk modulus tendon", "", no_tendon},
        {"Materials", "Sigma naught tendon base material", "", no_tendon},
        {"Materials", "Tendon base material factor", "", no_tendon},
        {"Materials", "Tendon base material constant 1", "", no_tendon},
        {"Materials", "Tendon base material constant 2", "", no_tendon},
        {"Materials", "Tendon base material constant 3", "", no_tendon},
        {"Materials", "Bulk modulus fat", "system/tissues/muscle/fat/bulk modulus"},
        {"Materials", "Fat factor", "system/tissues/muscle/fat/factor"},
        {"Materials", "Fat constant 1", "system/tissues/muscle/fat/c1"},
        {"Materials", "Fat fraction"}, // some versions have it in the table of points alone
        {"Materials", "QP list filename"},
    };

    /// The peer's parameters, each known and there.
    class PeerParameters
    {
    public:
      explicit PeerParameters(const std::filesystem::path &file)
        : file_(file.string())
        , entries_(read_prm(file))
        , full_(find("Geometry", "Muscle length") != nullptr)
        , rules_(common_rules)
      {
        const std::vector<Rule> &more = full_ ? full_rules : lite_rules;
        rules_.insert(rules_.end(), more.begin(), more.end());
        std::vector<InputProblem> problems;
        refuse_unknown(problems);
        refuse_missing(problems);
        if (!problems.empty())
          throw InputError(problems);
      }

      /// Whether these are parameters of the complete program, else of Flexodeal Lite.
      bool                     full() const { return full_; }
      const std::vector<Rule> &rules() const { return rules_; }

      const PrmEntry *find(const std::string &section, const std::string &name) const
      {
        for (const PrmEntry &entry : entries_)
          if (entry.section == section && entry.name == name)
            return &entry;
        return nullptr;
      }

      const std::string &text(const std::string &section, const std::string &name) const { return find(section, name)->text; }

      double positive(const std::string &section, const std::string &name) const
      {
        const auto value = parse_number(text(section, name));
        if (!value || !(*value > 0))
          refuse(section, name, "a number > 0");
        return *value;
      }

      int integer(const std::string &section, const std::string &name, const int low, const int high) const
      {
        const auto value = scene::parse_integer(text(section, name));
        if (!value || *value < low || *value > high)
          refuse(section, name, "an integer in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
        return *value;
      }

      [[noreturn]] void refuse(const std::string &section, const std::string &name, const std::string &expected,
                               const std::string &hint = "") const
      {
        const PrmEntry &entry = *find(section, name);
        throw InputError(InputProblem{file_ + ", line " + std::to_string(entry.line),
                                      name + " = \"" + entry.text + "\" cannot be carried over", expected, hint});
      }

    private:
      void refuse_unknown(std::vector<InputProblem> &problems) const
      {
        for (const PrmEntry &entry : entries_)
          {
            bool                     known = false;
            std::vector<std::string> names;
            for (const Rule &rule : rules_)
              {
                known = known || (entry.section == rule.section && entry.name == rule.name);
                if (entry.section == rule.section)
                  names.push_back(rule.name);
              }
            if (!known)
              problems.push_back({file_ + ", line " + std::to_string(entry.line),
                                  "unknown entry \"" + entry.name + "\" in subsection \"" + entry.section + "\"",
                                  std::string("an entry of Flexodeal") + (full_ ? "" : " Lite"),
                                  nearest_hint(entry.name, names, "nearest valid name")});
          }
      }

      /// What is not carried over may be absent.
      void refuse_missing(std::vector<InputProblem> &problems) const
      {
        const unsigned int last = entries_.empty() ? 1 : entries_.back().line;
        for (const Rule &rule : rules_)
          if (rule.lost[0] == '\0' && !may_be_absent(rule.name) && find(rule.section, rule.name) == nullptr)
            problems.push_back({file_ + ", line " + std::to_string(last),
                                std::string("up to here, \"") + rule.name + "\" of subsection \"" + rule.section + "\" is not set",
                                "set " + std::string(rule.name) + " = VALUE", ""});
      }

      static bool may_be_absent(const std::string &name)
      {
        return name == "Markers list file" || name == "Fat fraction" || name == "QP list filename";
      }

      std::string           file_;
      std::vector<PrmEntry> entries_;
      bool                  full_;
      std::vector<Rule>     rules_;
    };

    void add_profile(Settings &settings, const std::string &path, const std::filesystem::path &file)
    {
      settings.push_back({path + "/type", "control points"});
      settings.push_back({path + "/points", join(read_rows(file, 0, 2, "\"t value\", two finite numbers"), "; ")});
    }

    void add_mesh(Settings &settings, const PeerParameters &peer, const FlexodealOptions &options)
    {
      settings.push_back({"system/geometry/type", "mesh"});
      settings.push_back({"system/geometry/file", std::filesystem::proximate(options.mesh, options.scene.parent_path()).string()});
      settings.push_back({"system/geometry/scale", format_number(peer.positive("Geometry", "Grid scale"))});
      settings.push_back({"system/geometry/refinement", std::to_string(peer.integer("Geometry", "Global refinement", 0, 8))});
      settings.push_back({"system/line of action/from", options.ends[0]});
      settings.push_back({"system/line of action/to", options.ends[1]});
      settings.push_back({"system/line of action/direction", "1 0 0"});
    }

    void add_geometry(Settings &settings, const PeerParameters &peer, std::ostream &out)
    {
      const std::vector<std::pair<const char *, const char *>> of_block{{"Length", "length"}, {"Width", "width"}, {"Height", "height"}},
          of_gastrocnemius{{"Muscle length", "muscle length"},
                           {"Aponeurosis length", "aponeurosis length"},
                           {"Aponeurosis height", "aponeurosis height"},
                           {"Muscle width", "width"}};
      const double scale = peer.positive("Geometry", "Grid scale");
      settings.push_back({"system/geometry/type", peer.full() ? "idealised gastrocnemius" : "block"});
      for (const auto &[name, path] : peer.full() ? of_gastrocnemius : of_block)
        settings.push_back({std::string("system/geometry/") + path, format_number(scale * peer.positive("Geometry", name))});
      const int refinement = peer.integer("Geometry", "Global refinement", 0, 8);
      if (refinement == 0)
        out << "changed: Geometry / Global refinement = 0 becomes 1 (Flexodeal refines at least once)\n";
      settings.push_back({"system/geometry/refinement", std::to_string(std::max(1, refinement))});
    }

    /// The line of action of the peer is x, so its ends are the faces 0 and 1.
    void add_boundary(Settings &settings, const PeerParameters &peer, const FlexodealOptions &options)
    {
      const std::vector<std::string> ends   = options.mesh.empty() ? std::vector<std::string>{"x-", "x+"} : options.ends;
      const int                      face   = peer.integer("Prescribed displacement", "Pulling face ID", 0, 1);
      const std::string              moving = "system/boundary/moving end", fixed = "system/boundary/fixed end";
      settings.push_back({moving + "/face", ends[face]});
      settings.push_back({moving + "/type", "strain"});
      settings.push_back({moving + "/components", "x y z"});
      settings.push_back({moving + "/direction", face == 1 ? "1 0 0" : "-1 0 0"});
      add_profile(settings, moving + "/strain", options.strain);
      settings.push_back({fixed + "/face", ends[1 - face]});
      settings.push_back({fixed + "/type", "fixed"});
      settings.push_back({fixed + "/components", "x y z"});
    }

    double schedule_length(const std::string &steps)
    {
      const scene::Node node = scene::compose_scene(time_schema(), {{"steps", steps}, {"end", "1"}}, "command line: --steps");
      double            sum  = 0;
      for (const SchedulePiece &piece : parse_schedule(steps, node, "steps"))
        sum += piece.count * piece.size;
      return sum;
    }

    void add_time(Settings &settings, const PeerParameters &peer, const std::string &steps, std::ostream &out)
    {
      const double step = peer.positive("Time", "Time step size"), peer_end = peer.positive("Time", "End time");
      const double whole = std::floor(peer_end / step + 1e-6);
      if (steps.empty() && whole < 1)
        peer.refuse("Time", "End time", "at least one time step");
      settings.push_back({"time/end", format_number(steps.empty() ? whole * step : schedule_length(steps))});
      settings.push_back(steps.empty() ? scene::Setting{"time/step", peer.text("Time", "Time step size")}
                                       : scene::Setting{"time/steps", steps});
      if (steps.empty() && std::abs(whole * step - peer_end) > 1e-4 * step)
        out << "changed: Time / End time = " << peer.text("Time", "End time") << " is no whole number of steps; the scene ends at "
            << format_number(whole * step) << " s\n";
      settings.push_back({"time/boundary rates", "scheme"});
      settings.push_back({"time/start velocity", "impulse"});
      settings.push_back({"time/events", "ignore"});
      if (!steps.empty())
        out << "replaced by --steps: Time / Time step size = " << peer.text("Time", "Time step size")
            << ", End time = " << peer.text("Time", "End time") << "\n";
    }

    void name_what_is_lost(const PeerParameters &peer, const bool markers, const bool points, std::ostream &out)
    {
      for (const Rule &rule : peer.rules())
        if (const PrmEntry *entry = peer.find(rule.section, rule.name); entry != nullptr && rule.lost[0] != '\0')
          out << "not carried over: " << rule.section << " / " << rule.name << " = " << entry->text << " (" << rule.lost << ")\n";
      if (const PrmEntry *entry = peer.find("Measuring locations", "Markers list file"); entry != nullptr && !markers)
        out << "not carried over: Measuring locations / Markers list file = " << entry->text << " (give the file with --markers)\n";
      if (const PrmEntry *entry = peer.find("Materials", "QP list filename"); entry != nullptr && !points)
        out << "not carried over: Materials / QP list filename = " << entry->text << " (give the file with --qp-table)\n";
    }

    /// Without a mesh the body is the gastrocnemius between its layers.
    bool has_aponeurosis(const FlexodealOptions &options)
    {
      if (options.mesh.empty())
        return true;
      const std::vector<std::string> tissues = MeshBody(options.mesh, 1, options.mesh.string()).tissues;
      return std::find(tissues.begin(), tissues.end(), "aponeurosis") != tissues.end();
    }

    Settings translate(const FlexodealOptions &options, const PeerParameters &peer, std::ostream &out)
    {
      const std::string inertia = peer.text("Finite element system", "Type of simulation");
      Settings          settings{{"title", "Imported from " + options.parameters.filename().string()},
                        {"system/type", "muscle 3d"},
                        {"integrator/type", inertia == "dynamic" ? "backward euler" : "static"},
                        {"solver/nonlinear/relative tolerance", "1e-10"}, // so that the absolute one decides, as in the peer
                        {"output/series/slab", "whole cells"},
                        {"system/fibres/type", peer.full() ? "pennation angle" : "direction"}};
      if (peer.full())
        {
          const PrmEntry *fat = peer.find("Materials", "Fat fraction");
          settings.push_back({"system/tissues/muscle/fat/type", "neo-hookean"});
          settings.push_back({"system/tissues/muscle/fat/fraction", fat != nullptr ? fat->text : "0"});
        }
      const std::string pennation = "system/geometry/pennation angle", layers = "system/tissues/aponeurosis";
      for (const Rule &rule : peer.rules())
        if (std::string path = rule.path; !path.empty() && (path.rfind(layers, 0) != 0 || has_aponeurosis(options)))
          {
            if (path == pennation && !options.mesh.empty())
              path = "system/fibres/angle";
            settings.push_back({path, peer.text(rule.section, rule.name)});
          }
      if (options.mesh.empty())
        add_geometry(settings, peer, out);
      else
        add_mesh(settings, peer, options);
      add_boundary(settings, peer, options);
      add_profile(settings, "system/activation", options.activation);
      add_time(settings, peer, options.steps, out);
      if (!options.points.empty())
        {
          const PointProperties readable(options.points);
          settings.push_back({"system/fields/table", std::filesystem::proximate(options.points, options.scene.parent_path()).string()});
        }
      if (!options.markers.empty())
        settings.push_back(
            {"output/series/markers", join(read_rows(options.markers, 1, 4, "\"name x y z\" with coordinates in metres"), "; ")});
      return settings;
    }

    /// The text of the scene, read back through the validation that `run` does.
    std::string validated(const Settings &settings, const std::filesystem::path &file, const PeerParameters &peer)
    {
      const std::string   name   = file.string();
      const scene::Schema schema = root_schema(system_entry("muscle 3d", name));
      const std::string   xml    = scene::written_xml(scene::compose_scene(schema, settings, name, file.parent_path()));
      const scene::Node   again  = scene::parse_scene(xml, schema, name, file.parent_path());
      if (const Geometry body = read_muscle3d(again.section("system")).geometry; body.mesh)
        if (const std::string wrong = implausible_size(body); !wrong.empty())
          peer.refuse("Geometry", "Grid scale", "the factor that makes metres of the coordinates of the mesh", wrong);
      make_step_control(again.section("time"));
      return xml;
    }
  } // namespace

  void import_flexodeal(const FlexodealOptions &options, std::ostream &out)
  {
    const PeerParameters peer(options.parameters);
    const std::string    xml = validated(translate(options, peer, out), options.scene, peer);
    on_writing_rank(options.scene.string(), "a path in a folder that exists and can be written", "",
                    [&] { replace_file(options.scene, xml); });
    name_what_is_lost(peer, !options.markers.empty(), !options.points.empty(), out);
    out << "scene written: " << options.scene.string() << "\n";
  }
} // namespace myolines
