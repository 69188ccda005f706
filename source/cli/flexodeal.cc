// SPDX-License-Identifier: LGPL-2.1-or-later
#include "flexodeal_body.h"
#include "flexodeal_profiles.h"

#include <myolines/base/names.h>
#include <myolines/cli/experiment.h>
#include <myolines/cli/flexodeal.h>
#include <myolines/muscle3d/activation.h>
#include <myolines/output/text_file.h>
#include <myolines/scene/numbers.h>
#include <myolines/time/step_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace myolines
{
  namespace
  {
    using scene::format_number;

    const std::string moving_end = "system/boundary/moving end", fixed_end = "system/boundary/fixed end";

    /// The law is that of Yeoh where it has more than one constant. Returns whether there is fat.
    bool add_fat(FlexodealTranslation &t, const FlexodealBody &body)
    {
      const std::string fat   = "system/tissues/muscle/fat/";
      bool              given = false;
      for (const char *entry : {"Bulk modulus fat", "Fat factor", "Fat constant 1", "Fat constant 2", "Fat constant 3", "Fat fraction"})
        given = given || t.theirs.has("Materials", entry);
      if (!given && body.table_fat)
        t.out << "assumed: the parameters have no fat, the table of points has; its law and constants are the defaults of this program\n";
      if (!given)
        return false;
      const bool yeoh = t.theirs.has("Materials", "Fat constant 2") || t.theirs.has("Materials", "Fat constant 3");
      t.set(fat + "type", yeoh ? "yeoh" : "neo-hookean");
      if (yeoh)
        {
          t.take("Materials", "Fat constant 2", fat + "c2");
          t.take("Materials", "Fat constant 3", fat + "c3");
        }
      if (t.theirs.has("Materials", "Fat fraction"))
        t.take("Materials", "Fat fraction", fat + "fraction");
      else
        t.set(fat + "fraction", "0"); // it is in the table of points
      return true;
    }

    /// What is taken as it is: materials of the tissues that the body has, element and solver.
    void add_taken(FlexodealTranslation &t, const FlexodealBody &body)
    {
      const bool fat = add_fat(t, body);
      for (const FlexodealEntry &entry : flexodeal_entries())
        {
          const std::string path = entry.note;
          const auto        of   = [&path](const std::string &list) { return path.rfind("system/tissues/" + list + "/", 0) == 0; };
          const bool        idle =
              (of("muscle/fat") && !fat) || (of("aponeurosis") && !body.has("aponeurosis")) || (of("tendon") && !body.has("tendon"));
          if (entry.fate == FlexodealEntry::Fate::taken && !idle)
            t.take(entry.section, entry.name, path);
        }
    }

    void set_profile(FlexodealTranslation &t, const std::string &path, const FlexodealProfile &profile)
    {
      t.set(path + "/type", "control points", profile.origin);
      t.set(path + "/points", profile.points, profile.origin);
    }

    /// Whether a ramp among the parameters is taken: a file of control points comes first. @throws InputError without both.
    bool takes_ramp(FlexodealTranslation &t, const std::string &section, const std::vector<std::string> &names,
                    const std::filesystem::path &file, const std::string &missing)
    {
      if (file.empty() && !t.theirs.has(section, names[0]))
        throw InputError(InputProblem{"command line",
                                      missing + " is not given, and " + t.options.parameters.string() + " has no " + names[0],
                                      "import flexodeal PARAMETERS.prm STRAIN.dat ACTIVATION.dat --out SCENE.xml", ""});
      if (file.empty())
        return true;
      for (const std::string &name : names)
        if (const PrmEntry *entry = t.theirs.optional(section, name))
          t.out << "replaced by " << file.string() << ": " << section << " / " << name << " = " << entry->text << "\n";
      return false;
    }

    FlexodealProfile strain_of(FlexodealTranslation &t)
    {
      return takes_ramp(t, "Prescribed displacement", {"Pull strain", "Pull strain rate", "Pull time start", "Pull time end"},
                        t.options.strain, "STRAIN.dat")
                 ? strain_ramp(t.theirs, t.theirs.positive("Geometry", "Length") * t.theirs.positive("Geometry", "Grid scale"))
                 : read_control_points(t.options.strain, "strain", scene::Range{-1, std::numeric_limits<double>::infinity(), true, false});
    }

    FlexodealProfile activation_of(FlexodealTranslation &t)
    {
      return takes_ramp(t, "Activation", {"Activation level", "Activation start", "Activation end"}, t.options.activation, "ACTIVATION.dat")
                 ? activation_ramp(t.theirs)
                 : read_control_points(t.options.activation, "activation", activation_range);
    }

    /// In a mesh strains are parts of a length among the parameters. Flexodeal forgets Grid scale there, which would move the face of a
    /// body that is given in millimetres by metres.
    void add_reference_length(FlexodealTranslation &t, const Geometry &geometry)
    {
      const std::string name = t.theirs.has("Geometry", "Muscle length") ? "Muscle length" : "Length";
      if (!t.theirs.has("Geometry", name))
        return;
      const double    length = t.theirs.positive("Geometry", name);
      const PrmEntry &given  = t.theirs.needed("Geometry", name);
      if (!geometry.mesh)
        {
          if (t.theirs.positive("Geometry", "Grid scale") != 1 && !t.options.strain.empty())
            t.out << "changed: strains are parts of " << name << " times Grid scale; Flexodeal takes " << name << " = " << given.text
                  << " m\n";
          return;
        }
      t.set(moving_end + "/reference length", format_number(length), t.theirs.where(given));
      if (std::abs(length - geometry.size[0]) > 0.1 * geometry.size[0])
        t.out << "Warning: strains are parts of " << name << " = " << given.text << " m, as in Flexodeal; the mesh is " << geometry.size[0]
              << " m long\n";
    }

    /// The face with the number @p boundary_id, or, of a mesh, that which --ends names in the place @p end.
    std::string end_face(FlexodealTranslation &t, const FlexodealBody &body, const int boundary_id, const std::size_t end)
    {
      if (end < t.options.ends.size())
        return t.options.ends[end];
      const std::string face = body.face(boundary_id);
      if (face.empty())
        t.theirs.refuse(t.theirs.needed("Prescribed displacement", "Pulling face ID"), "the number of a face",
                        (body.geometry.mesh ? "or --ends HELD PULLED, with the faces of the mesh: " : "the faces are, from 0 on: ") +
                            body.faces());
      return face;
    }

    /// Flexodeal holds the face 0 and moves the pulled one along x, its line of action.
    void add_boundary(FlexodealTranslation &t, const FlexodealBody &body)
    {
      const int         pulled = t.theirs.integer("Prescribed displacement", "Pulling face ID", 0, 255);
      const std::string held   = end_face(t, body, 0, 0);
      const std::string moved  = end_face(t, body, std::max(1, pulled), 1);
      const std::string origin = t.options.ends.empty() ? t.options.mesh.string() : "command line: --ends";
      if (body.geometry.mesh)
        {
          t.set("system/line of action/from", held, origin);
          t.set("system/line of action/to", moved, origin);
          t.set("system/line of action/direction", "1 0 0");
        }
      if (pulled == 0)
        {
          t.set("output/series/force face", held);
          t.out << "changed: nothing is pulled, because Pulling face ID = 0 is the face that Flexodeal holds"
                << (t.options.strain.empty() ? "" : "; not used: " + t.options.strain.string()) << "\n";
        }
      else
        {
          t.set(moving_end + "/face", moved, origin);
          t.set(moving_end + "/type", "strain");
          t.set(moving_end + "/components", "x y z");
          t.set(moving_end + "/direction", "1 0 0");
          add_reference_length(t, body.geometry);
          set_profile(t, moving_end + "/strain", strain_of(t));
        }
      t.set(fixed_end + "/face", held, origin);
      t.set(fixed_end + "/type", "fixed");
      t.set(fixed_end + "/components", "x y z");
    }

    /// Dead loads. Flexodeal's positive pressures pull.
    void add_pressures(FlexodealTranslation &t, const FlexodealBody &body)
    {
      if (t.options.pressures.empty())
        return;
      const std::string file = t.options.pressures.string();
      for (const FlexodealPressure &pressure : read_pressures(t.options.pressures))
        {
          const std::string face = body.face(pressure.face), number = std::to_string(pressure.face);
          const std::string path = "system/boundary/pressure on face " + number;
          if (face.empty())
            throw InputError(
                InputProblem{pressure.origin, "there is no face " + number, "numbers of faces", "the faces are: " + body.faces()});
          t.set(path + "/face", face, file);
          t.set(path + "/type", "pressure");
          t.set(path + "/pressure", "-1");
          set_profile(t, path + "/profile", {pressure.points, file});
        }
    }

    /// Flexodeal adds up the times of its steps, and makes those that are below End time.
    double steps_below(const double end, const double step)
    {
      double n = 0;
      for (double t = step; t < end; t += step)
        ++n;
      return n;
    }

    double schedule_length(const std::string &steps)
    {
      const scene::Node node = scene::compose_scene(time_schema(), {{"steps", steps}, {"end", "1"}}, "command line: --steps");
      double            sum  = 0;
      for (const SchedulePiece &piece : parse_schedule(steps, node, "steps"))
        sum += piece.count * piece.size;
      return sum;
    }

    void add_time(FlexodealTranslation &t)
    {
      const std::string &steps = t.options.steps;
      const double       step = t.theirs.positive("Time", "Time step size"), their_end = t.theirs.positive("Time", "End time");
      const PrmEntry    &given_step = t.theirs.needed("Time", "Time step size"), &given_end = t.theirs.needed("Time", "End time");
      constexpr double   most = 1e7;
      if (steps.empty() && !(their_end / step < most))
        t.theirs.refuse(given_step, "less than 1e7 steps until End time");
      const double whole = steps.empty() ? steps_below(their_end, step) : 0, end = steps.empty() ? whole * step : schedule_length(steps);
      if (steps.empty() && whole < 1)
        t.theirs.refuse(given_end, "more than one time step", "Flexodeal makes the steps that end before End time");
      if (!steps.empty())
        t.out << "replaced by --steps: Time / Time step size = " << given_step.text << ", End time = " << given_end.text << "\n";
      else if (std::abs(end - their_end) > 1e-4 * step)
        t.out << "changed: Time / End time = " << given_end.text << "; the scene ends at " << format_number(end)
              << " s, with the last step that Flexodeal makes before it\n";
      t.set("time/end", format_number(end), t.theirs.where(given_end));
      if (steps.empty())
        t.set("time/step", given_step.text, t.theirs.where(given_step));
      else
        t.set("time/steps", steps, "command line: --steps");
      t.set("time/boundary rates", "scheme");
      t.set("time/start velocity", "impulse");
      t.set("time/events", "ignore");
    }

    void add_markers(FlexodealTranslation &t)
    {
      const PrmEntry *list = t.theirs.optional("Measuring locations", "Markers list file");
      if (list != nullptr && t.options.markers.empty())
        t.out << "not carried over: Measuring locations / Markers list file = " << list->text << " (give the file with --markers)\n";
      const std::string        path = "output/series/markers";
      std::vector<std::string> markers;
      for (const FlexodealMarker &marker : read_flexodeal_markers(t.options.markers, t.theirs))
        {
          markers.push_back(marker.name + " " + marker.position);
          t.set_origin(path, marker.name, marker.origin);
        }
      if (!markers.empty())
        t.set(path, join(markers, "; "));
      else if (!t.options.markers.empty())
        t.out << "no markers in " << t.options.markers.string() << "\n";
    }

    FlexodealBody translate(FlexodealTranslation &t)
    {
      const bool dynamic = t.theirs.needed("Finite element system", "Type of simulation").text == "dynamic";
      t.set("title", "Imported from " + t.options.parameters.filename().string());
      t.set("system/type", "muscle 3d");
      t.set("integrator/type", dynamic ? "backward euler" : "static");
      t.set("solver/nonlinear/relative tolerance", "1e-10"); // so that the absolute one decides, as in Flexodeal
      t.set("output/series/slab", "whole cells");
      const FlexodealBody body = add_body(t);
      add_taken(t, body);
      add_fibres(t, body);
      add_boundary(t, body);
      add_pressures(t, body);
      set_profile(t, "system/activation", activation_of(t));
      add_time(t);
      add_markers(t);
      return body;
    }

    /// The text of the scene, in which all that `check` does has found nothing, on a mesh refined once at most.
    std::string validated(const FlexodealTranslation &t, const FlexodealBody &body)
    {
      const std::string           name   = t.options.scene.string();
      const std::filesystem::path folder = t.options.scene.parent_path();
      try
        {
          const scene::Schema schema = root_schema(system_entry("muscle 3d", name));
          const std::string   xml    = scene::written_xml(scene::compose_scene(schema, t.settings(), name, folder));
          const std::string   coarse = "system/geometry/refinement=" + std::to_string(std::min(1, body.refinement));
          const Experiment    experiment(scene::parse_scene(xml, schema, name, folder, {coarse}));
          for (const std::string &warning : experiment.assembled().warnings)
            t.out << "Warning: " << warning << "\n";
          return xml;
        }
      catch (const InputError &error)
        {
          throw t.at_origins(error, name);
        }
    }
  } // namespace

  void import_flexodeal(const FlexodealOptions &options, std::ostream &out)
  {
    FlexodealOptions given = options;
    for (std::filesystem::path *file : {&given.strain, &given.activation})
      if (*file == "-")
        file->clear();
    FlexodealTranslation translation(given, out);
    const FlexodealBody  body = translate(translation);
    const std::string    xml  = validated(translation, body);
    on_writing_rank(options.scene.string(), "a path in a folder that exists and can be written", "",
                    [&] { replace_file(options.scene, xml); });
    translation.theirs.tell_what_is_lost(out);
    out << "scene written: " << options.scene.string() << "\nrun it: " << shell_text({"myolines", "run", options.scene.string()}) << "\n";
  }
} // namespace myolines
