// SPDX-License-Identifier: LGPL-2.1-or-later
// The table of integrators in the muscle: error, ringing and cost of every scheme and number of steps on the kinked block, each beside
// what the study of tests/data/integrators_3d.csv found. doc/results/integrators_in_the_muscle.md shows it.
//   integrators_in_the_muscle REFINEMENT [STEPS_OF_REFERENCE [DATA_FOR_GNUPLOT [PATH=VALUE...]]]
// Exit code 1: a number of ours is not that of the study to the digits printed there. Such numbers are bold.

#include "../muscle_integrators/measured_run.h"
#include "../muscle_integrators/study.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  std::string digits(const double x, const int n = 2)
  {
    std::ostringstream text;
    text << std::scientific << std::setprecision(n - 1) << x;
    return text.str();
  }

  std::string fixed(const double x, const int n = 2)
  {
    std::ostringstream text;
    text << std::fixed << std::setprecision(n) << x;
    return text.str();
  }

  std::string join(const std::vector<std::string> &parts, const std::string &between)
  {
    std::string all;
    for (const std::string &part : parts)
      all += (all.empty() ? "" : between) + part;
    return all;
  }

  struct Row
  {
    std::vector<std::string> errors, orders, velocity_errors, variations, newton, seconds;
    bool                     agrees = true;

    /// "ours (theirs)".
    std::string beside(const std::string &ours, const std::string &theirs, const bool agree)
    {
      agrees = agrees && agree;
      return agree ? ours + " (" + theirs + ")" : "**" + ours + "** (" + theirs + ")";
    }
  };

  void fail(Row &row)
  {
    for (std::vector<std::string> *cells : {&row.errors, &row.variations, &row.newton, &row.seconds})
      cells->push_back("fails");
    row.agrees = false;
  }

  Row row(const Scheme &scheme, const unsigned int refinement, const std::vector<StudyEntry> &study, const MeasuredRun &reference,
          const Overrides &more, std::ostream &data)
  {
    Row    row;
    double last = 0;
    data << '"' << scheme.name << "\"\n";
    for (const StudyEntry &theirs : study)
      {
        MeasuredRun run;
        try
          {
            run = kinked_run(scheme, theirs.n, refinement, more);
          }
        catch (const SolveError &)
          {
            fail(row);
            last = 0;
            continue;
          }
        const double error = relative_error(run.u, reference.u);
        row.errors.push_back(row.beside(digits(error), digits(theirs.error), same_digits(error, theirs.error)));
        if (last > 0)
          row.orders.push_back(fixed(std::log2(last / error)));
        last = error;
        if (theirs.velocity_error)
          {
            const double velocity_error = relative_error(run.v, reference.v);
            row.velocity_errors.push_back(
                row.beside(digits(velocity_error), digits(*theirs.velocity_error), same_digits(velocity_error, *theirs.velocity_error)));
          }
        const double variation = relative_variation(run.mid_velocity, reference.mid_velocity);
        row.variations.push_back(row.beside(fixed(variation), fixed(theirs.variation), std::abs(variation - theirs.variation) < 0.015));
        row.newton.push_back(fixed(run.newton_per_stage, 1));
        row.seconds.push_back(fixed(run.cpu_seconds));
        data << theirs.n << ' ' << digits(error, 6) << ' ' << digits(run.cpu_seconds, 4) << '\n';
      }
    data << "\n\n";
    return row;
  }
} // namespace

int main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc < 2)
    {
      std::cerr << "integrators_in_the_muscle REFINEMENT [STEPS_OF_REFERENCE [DATA_FOR_GNUPLOT [PATH=VALUE...]]]\n";
      return 2;
    }
  const unsigned int refinement = std::stoul(argv[1]), finest = argc > 2 ? std::stoul(argv[2]) : steps_of_reference(refinement);
  std::ofstream      data(argc > 3 ? argv[3] : "/dev/null");
  const Overrides    more(argv + std::min(argc, 4), argv + argc);
  const MeasuredRun  reference = kinked_run(scheme("sdirk3"), finest, refinement, more);
  const MeasuredRun  coarser   = kinked_run(scheme("sdirk3"), finest / 2, refinement, more);
  std::cout << "Refinement " << refinement << ", reference SDIRK3 with " << finest << " steps; half as many differ by "
            << digits(relative_error(coarser.u, reference.u)) << " in u, " << digits(relative_error(coarser.v, reference.v))
            << " in v.\n\n";
  bool agree = true, headed = false;
  for (const Scheme &scheme : schemes())
    {
      const std::vector<StudyEntry> theirs = study(refinement, scheme.name);
      if (!headed)
        {
          std::vector<std::string> head{"scheme"};
          for (const StudyEntry &entry : theirs)
            head.push_back("eU n=" + std::to_string(entry.n));
          head.insert(head.end(), {"orders", "eV first / last n", "TV", "Newton per stage", "CPU s"});
          std::cout << "| " << join(head, " | ") << " |\n|" << join(std::vector<std::string>(head.size(), "---"), "|") << "|\n";
          headed = true;
        }
      const Row row = ::row(scheme, refinement, theirs, reference, more, data);
      agree         = agree && row.agrees;
      std::cout << "| " << scheme.name << " | " << join(row.errors, " | ") << " | " << join(row.orders, ", ") << " | "
                << join(row.velocity_errors, " / ") << " | " << join(row.variations, " / ") << " | " << join(row.newton, " / ") << " | "
                << join(row.seconds, " / ") << " |" << std::endl;
    }
  return agree ? 0 : 1;
}
