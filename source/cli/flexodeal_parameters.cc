// SPDX-License-Identifier: LGPL-2.1-or-later
#include "flexodeal_parameters.h"

#include <myolines/base/names.h>
#include <myolines/scene/numbers.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace myolines
{
  namespace
  {
    using Fate = FlexodealEntry::Fate;

    const char *const own_solver   = "the solvers here have settings of their own";
    const char *const other_output = "outputs are chosen in the list \"output\"";
    const char *const step44       = "this is the material of deal.II's step 44, from before Flexodeal had muscle: "
                                     "drop the subsection and give the muscle in a subsection \"Materials\"";

    const FlexodealEntry *entry_of(const PrmEntry &entry)
    {
      for (const FlexodealEntry &known : flexodeal_entries())
        if (entry.section == known.section && entry.name == known.name)
          return &known;
      return nullptr;
    }
  } // namespace

  const std::vector<FlexodealEntry> &flexodeal_entries()
  {
    static const std::vector<FlexodealEntry> entries{
        {"Finite element system", "Polynomial degree", Fate::taken, "system/discretisation/degree"},
        {"Finite element system", "Quadrature order", Fate::taken, "system/discretisation/quadrature points"},
        {"Finite element system", "Type of simulation", Fate::taken, "system/inertia"},

        {"Geometry", "Global refinement", Fate::read},
        {"Geometry", "Grid scale", Fate::read},
        {"Geometry", "Length", Fate::read}, // of a block
        {"Geometry", "Width", Fate::read},
        {"Geometry", "Height", Fate::read},
        {"Geometry", "Muscle length", Fate::read}, // of the idealised gastrocnemius
        {"Geometry", "Aponeurosis length", Fate::read},
        {"Geometry", "Aponeurosis height", Fate::read},
        {"Geometry", "Muscle width", Fate::read},
        {"Geometry", "Pennation angle", Fate::read},
        {"Geometry", "Fibre length", Fate::read}, // of a belly between parallel sheets
        {"Geometry", "Pressure ratio p/p0", Fate::passed_over, "Flexodeal applies no such pressure either"},

        {"Materials", "Muscle density", Fate::taken, "system/tissues/muscle/density"},
        {"Materials", "Sigma naught muscle", Fate::taken, "system/tissues/muscle/fibre/maximum isometric stress"},
        {"Materials", "Bulk modulus muscle", Fate::taken, "system/tissues/muscle/bulk modulus"},
        {"Materials", "Max strain rate", Fate::taken, "system/tissues/muscle/fibre/maximum strain rate"},
        {"Materials", "Sigma naught base material", Fate::taken, "system/tissues/muscle/base/stress scale"},
        {"Materials", "Muscle base material factor", Fate::taken, "system/tissues/muscle/base/factor"},
        {"Materials", "Muscle base material constant 1", Fate::taken, "system/tissues/muscle/base/c1"},
        {"Materials", "Muscle base material constant 2", Fate::taken, "system/tissues/muscle/base/c2"},
        {"Materials", "Muscle base material constant 3", Fate::taken, "system/tissues/muscle/base/c3"},
        {"Materials", "Muscle x component", Fate::read},
        {"Materials", "Muscle y component", Fate::read},
        {"Materials", "Muscle z component", Fate::read},
        {"Materials", "QP list filename", Fate::read},

        {"Materials", "Bulk modulus fat", Fate::taken, "system/tissues/muscle/fat/bulk modulus"},
        {"Materials", "Fat factor", Fate::taken, "system/tissues/muscle/fat/factor"},
        {"Materials", "Fat constant 1", Fate::taken, "system/tissues/muscle/fat/c1"},
        {"Materials", "Fat constant 2", Fate::read}, // of the law of Yeoh alone
        {"Materials", "Fat constant 3", Fate::read},
        {"Materials", "Fat fraction", Fate::read}, // some versions have it in the table of points alone

        {"Materials", "Sigma naught aponeurosis", Fate::taken, "system/tissues/aponeurosis/fibre/stress scale"},
        {"Materials", "Bulk modulus aponeurosis", Fate::taken, "system/tissues/aponeurosis/bulk modulus"},
        {"Materials", "Sigma naught aponeurosis base material", Fate::taken, "system/tissues/aponeurosis/base/stress scale"},
        {"Materials", "Aponeurosis base material factor", Fate::taken, "system/tissues/aponeurosis/base/factor"},
        {"Materials", "Aponeurosis base material constant 1", Fate::taken, "system/tissues/aponeurosis/base/c1"},
        {"Materials", "Aponeurosis base material constant 2", Fate::taken, "system/tissues/aponeurosis/base/c2"},
        {"Materials", "Aponeurosis base material constant 3", Fate::taken, "system/tissues/aponeurosis/base/c3"},

        {"Materials", "Sigma naught tendon", Fate::taken, "system/tissues/tendon/fibre/stress scale"},
        {"Materials", "Bulk modulus tendon", Fate::taken, "system/tissues/tendon/bulk modulus"},
        {"Materials", "Sigma naught tendon base material", Fate::taken, "system/tissues/tendon/base/stress scale"},
        {"Materials", "Tendon base material factor", Fate::taken, "system/tissues/tendon/base/factor"},
        {"Materials", "Tendon base material constant 1", Fate::taken, "system/tissues/tendon/base/c1"},
        {"Materials", "Tendon base material constant 2", Fate::taken, "system/tissues/tendon/base/c2"},
        {"Materials", "Tendon base material constant 3", Fate::taken, "system/tissues/tendon/base/c3"},

        {"Material properties", "Poisson's ratio", Fate::refused, step44},
        {"Material properties", "Shear modulus", Fate::refused, step44},

        // The earliest versions have ramps here, all later ones files of control points.
        {"Activation", "Activation level", Fate::read},
        {"Activation", "Activation start", Fate::read},
        {"Activation", "Activation end", Fate::read},
        {"Prescribed displacement", "Pulling face ID", Fate::read},
        {"Prescribed displacement", "Pull time start", Fate::read},
        {"Prescribed displacement", "Pull time end", Fate::read},
        {"Prescribed displacement", "Pull strain", Fate::read},
        {"Prescribed displacement", "Pull strain rate", Fate::read},

        {"Time", "End time", Fate::read},
        {"Time", "Time step size", Fate::read},

        {"Nonlinear solver", "Max iterations Newton-Raphson", Fate::taken, "solver/nonlinear/maximum iterations"},
        {"Nonlinear solver", "Tolerance force", Fate::taken, "solver/nonlinear/absolute tolerance"},
        {"Nonlinear solver", "Tolerance displacement", Fate::passed_over, "convergence is judged by the residual"},
        {"Nonlinear solver", "Nonlinear solver type", Fate::passed_over, own_solver},
        {"Linear solver", "Max iteration multiplier", Fate::passed_over, own_solver},
        {"Linear solver", "Residual", Fate::passed_over, own_solver},
        {"Linear solver", "Preconditioner type", Fate::passed_over, own_solver},
        {"Linear solver", "Preconditioner relaxation", Fate::passed_over, own_solver},
        {"Linear solver", "Solver type", Fate::passed_over, own_solver},
        {"Linear solver", "Use static condensation", Fate::passed_over, "pressure and dilatation are always eliminated"},

        {"Measuring locations", "Markers list file", Fate::read},
        {"Measuring locations", "Left X", Fate::read},
        {"Measuring locations", "Left Y", Fate::read},
        {"Measuring locations", "Left Z", Fate::read},
        {"Measuring locations", "Mid X", Fate::read},
        {"Measuring locations", "Mid Y", Fate::read},
        {"Measuring locations", "Mid Z", Fate::read},
        {"Measuring locations", "Right X", Fate::read},
        {"Measuring locations", "Right Y", Fate::read},
        {"Measuring locations", "Right Z", Fate::read},
        {"Output binary files", "Output binary files main variables", Fate::passed_over, other_output},
        {"Output binary files", "Output binary files tensors", Fate::passed_over, other_output}};
    return entries;
  }

  FlexodealParameters::FlexodealParameters(const std::filesystem::path &file)
    : file_(file.string())
    , entries_(read_prm(file))
  {
    std::vector<InputProblem> problems;
    for (const PrmEntry &entry : entries_)
      if (const FlexodealEntry *known = entry_of(entry); known == nullptr)
        problems.push_back(unknown(entry));
      else if (known->fate == Fate::refused)
        problems.push_back({where(entry), "is not known here", "entries of muscle", known->note});
    if (!problems.empty())
      throw InputError(problems);
  }

  InputProblem FlexodealParameters::unknown(const PrmEntry &entry) const
  {
    std::vector<std::string> names, sections;
    std::string              home;
    for (const FlexodealEntry &known : flexodeal_entries())
      {
        sections.push_back(known.section);
        if (entry.section == known.section)
          names.push_back(known.name);
        if (entry.name == known.name)
          home = known.section;
      }
    const std::string hint = !home.empty()   ? "it belongs to subsection \"" + home + "\""
                             : names.empty() ? nearest_hint(entry.section, sections, "nearest valid subsection")
                                             : nearest_hint(entry.name, names, "nearest valid name");
    return {file_ + ", line " + std::to_string(entry.line), "unknown entry \"" + entry.name + "\" in subsection \"" + entry.section + "\"",
            "an entry of Flexodeal or Flexodeal Lite", hint};
  }

  const PrmEntry *FlexodealParameters::find(const std::string &section, const std::string &name) const
  {
    for (const PrmEntry &entry : entries_)
      if (entry.section == section && entry.name == name)
        return &entry;
    return nullptr;
  }

  const PrmEntry *FlexodealParameters::optional(const std::string &section, const std::string &name)
  {
    const PrmEntry *entry = find(section, name);
    if (entry != nullptr)
      asked_for_.insert(entry);
    return entry;
  }

  const PrmEntry &FlexodealParameters::needed(const std::string &section, const std::string &name)
  {
    if (const PrmEntry *entry = optional(section, name))
      return *entry;
    const unsigned int last = entries_.empty() ? 1 : entries_.back().line;
    throw InputError(InputProblem{file_ + ", line " + std::to_string(last),
                                  "up to here, \"" + name + "\" of subsection \"" + section + "\" is not set", "set " + name + " = VALUE",
                                  ""});
  }

  double FlexodealParameters::number(const std::string &section, const std::string &name)
  {
    const PrmEntry &entry = needed(section, name);
    const auto      value = scene::parse_number(entry.text);
    if (!value)
      refuse(entry, "a number",
             entry.text.find(',') != std::string::npos ? "decimals have a point: 0.03"
             : std::isdigit(static_cast<unsigned char>(entry.text[0]))
                 ? "a number alone, without a unit: lengths are in metres, times in seconds"
                 : "");
    return *value;
  }

  double FlexodealParameters::positive(const std::string &section, const std::string &name)
  {
    const double value = number(section, name);
    if (!(value > 0))
      refuse(needed(section, name), "a number > 0");
    return value;
  }

  int FlexodealParameters::integer(const std::string &section, const std::string &name, const int low, const int high)
  {
    const PrmEntry &entry = needed(section, name);
    const auto      value = scene::parse_integer(entry.text);
    if (!value || *value < low || *value > high)
      refuse(entry, "an integer in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
    return *value;
  }

  std::string FlexodealParameters::where(const PrmEntry &entry) const
  {
    return file_ + ", line " + std::to_string(entry.line) + ": " + entry.name;
  }

  void FlexodealParameters::refuse(const PrmEntry &entry, const std::string &expected, const std::string &hint) const
  {
    throw InputError(InputProblem{file_ + ", line " + std::to_string(entry.line),
                                  entry.name + " = \"" + entry.text + "\" cannot be carried over", expected, hint});
  }

  void FlexodealParameters::tell_what_is_lost(std::ostream &out) const
  {
    std::vector<std::pair<std::string, std::vector<std::string>>> lost; // reason, entries
    for (const PrmEntry &entry : entries_)
      {
        const FlexodealEntry &known = *entry_of(entry);
        if (known.fate != Fate::passed_over && asked_for_.count(&entry) != 0)
          continue;
        const std::string reason = known.fate == Fate::passed_over ? known.note : "this body does not use them";
        auto              same   = std::find_if(lost.begin(), lost.end(), [&reason](const auto &group) { return group.first == reason; });
        if (same == lost.end())
          same = lost.insert(lost.end(), {reason, {}});
        same->second.push_back(entry.name + " = " + entry.text);
      }
    for (const auto &[reason, entries] : lost)
      out << "not carried over (" << reason << "): " << join(entries) << "\n";
  }
} // namespace myolines
