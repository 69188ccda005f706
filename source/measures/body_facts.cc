// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/muscle3d/point_states.h>

#include <myolines/measures/body_facts.h>
#include <myolines/measures/fascicles.h>
#include <myolines/measures/rigid_motions.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    std::string tell_line(const Muscle3dSystem &system)
    {
      const LineChoice &choice = system.line_of_action();
      if (!choice.line)
        return "line of action: none, " + choice.why_none + "; what is measured along it is left out (\"system/line of action\" gives one)";
      const LineOfAction             &line  = *choice.line;
      const std::vector<std::string> &faces = face_names(system.parameters().geometry);
      std::ostringstream              text;
      text << "line of action: from " << faces[line.from] << " to " << faces[line.to] << ", direction (";
      for (unsigned int c = 0; c < 3; ++c)
        text << (c == 0 ? "" : " ")
             << (std::abs(line.direction[c]) < 1e-12 ? 0. : line.direction[c]); // of unit length: the rest is rounding
      text << "), length " << line.length << " m";
      return text.str();
    }

    struct Totals
    {
      double volume = 0, mass = 0, muscle = 0, stress = 0; ///< [m^3], [kg], of muscle [m^3], of its maximum isometric stress [N m]
      std::vector<double> tissues;                         ///< volumes by material id, from 1 [m^3]
    };

    Totals add_up(const Muscle3dSystem &system)
    {
      const State still = system.still_state();
      Totals      t;
      t.tissues.resize(system.parameters().tissue_names.size());
      PointStates(system, still).for_each([&](const NodeSpace::Cell &, int, const PointState &p) {
        t.volume += p.JxW;
        t.mass += p.JxW * p.material[material_density];
        t.tissues.at(p.material_id - 1) += p.JxW;
        if (p.material_id == muscle_id)
          {
            t.muscle += p.JxW;
            t.stress += p.JxW * p.material[material_active];
          }
      });
      for (double *x : {&t.volume, &t.mass, &t.muscle, &t.stress})
        *x = dealii::Utilities::MPI::sum(*x, system.discretisation().communicator);
      for (double &x : t.tissues)
        x = dealii::Utilities::MPI::sum(x, system.discretisation().communicator);
      return t;
    }
  } // namespace

  std::vector<std::string> body_facts(const Muscle3dSystem &system)
  {
    std::vector<std::string> lines{tell_line(system)};
    const auto               add = [&](const auto &...parts) {
      std::ostringstream text;
      (text << ... << parts);
      lines.push_back(text.str());
    };
    const Totals t = add_up(system);
    if (const FreeMotions free = free_motions(system.parameters(), system.discretisation()); free.any())
      add("free: nothing holds the body against ", free.words());
    std::ostringstream tissues;
    for (std::size_t i = 0; i < t.tissues.size(); ++i)
      if (t.tissues[i] > 0)
        tissues << "; " << system.parameters().tissue_names[i] << ": " << t.tissues[i] << " m^3";
    add("body: ", t.volume, " m^3, ", t.mass, " kg", tissues.str());
    if (!(t.muscle > 0))
      return lines;

    const Fascicles                  fascicles(system, enough_fascicles);
    const std::vector<double>       &lengths = fascicles.rest_lengths();
    const std::array<std::size_t, 3> ends    = fascicles.ends();
    if (ends[2] > 0)
      add("fascicles: ", ends[2], " lines along the fibres do not end, and are left out");
    if (lengths.empty())
      return lines;
    const double mean = fascicles.mean_rest_length();
    add("fascicles: ", lengths.size(), " lines along the fibres, ", *std::min_element(lengths.begin(), lengths.end()), " to ",
        *std::max_element(lengths.begin(), lengths.end()), " m, mean ", mean, " m; ", ends[0], " ends at the surface, ", ends[1],
        " at another tissue");
    add("cross-section: ", t.muscle / mean, " m^2 (volume of muscle over mean length of fascicles); F_0: ", t.stress / mean, " N");
    return lines;
  }
} // namespace myolines
