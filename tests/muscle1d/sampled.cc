#include "../support/complaint.h"
#include "../support/temporary.h"
#include "run.h"

#include <myolines/base/error.h>
#include <myolines/muscle1d/gait.h>
#include <myolines/muscle1d/sampled.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace myolines;
using namespace myolines::testing;

namespace
{
  std::vector<double> uneven(const unsigned int n, const double end)
  {
    std::vector<double> t;
    for (unsigned int i = 0; i < n; ++i)
      t.push_back(end * (i + 0.3 * std::sin(1.7 * i) * (i > 0 && i + 1 < n)) / (n - 1));
    return t;
  }

  std::vector<double> of(const std::vector<double> &t, const std::function<double(double)> &f)
  {
    std::vector<double> x;
    for (const double time : t)
      x.push_back(f(time));
    return x;
  }

  struct File
  {
    explicit File(const std::string &text)
      : path(myolines::test::temporary("samples.csv"))
    {
      std::ofstream(path) << text;
    }
    ~File() { std::filesystem::remove(path); }
    const std::filesystem::path path;
  };

  using test::complaint;
} // namespace

TEST(SampledDrive, splineConvergesWithOrderFourInside)
{
  const auto error = [](const unsigned int n) {
    const auto         t      = uneven(n, 2);
    const SampledDrive spline = SampledDrive::spline(t, of(t, [](double x) { return std::sin(3 * x); }), INFINITY);
    double             worst  = 0;
    for (double x = 0.8; x < 1.2; x += 0.01)
      worst = std::max(worst, std::abs(spline.value(x, Side::left) - std::sin(3 * x)));
    return worst;
  };
  EXPECT_NEAR(std::log2(error(81) / error(161)), 4, 0.5);
}

TEST(SampledDrive, derivativesAreThoseOfTheValue)
{
  const auto         t = uneven(21, 2);
  const SampledDrive s = SampledDrive::spline(t, of(t, [](double x) { return std::sin(3 * x); }), 2);
  for (double x = 0.013; x < 2; x += 0.0971)
    {
      const double h = 1e-5;
      EXPECT_NEAR((s.value(x + h, Side::left) - s.value(x - h, Side::left)) / (2 * h), s.first_derivative(x, Side::left), 1e-8);
      EXPECT_NEAR((s.first_derivative(x + h, Side::left) - s.first_derivative(x - h, Side::left)) / (2 * h),
                  s.second_derivative(x, Side::left), 1e-5);
    }
  EXPECT_EQ(s.kinks(-1, 3), (std::vector<double>{0, 2}));
  EXPECT_TRUE(s.kinks(0, 2).empty());
}

// The linear system of the smoothing spline keeps straight lines, and halves oscillations of the cut-off frequency.
TEST(SampledDrive, smoothsWhatIsFast)
{
  const auto         t    = uneven(50, 3);
  const SampledDrive line = SampledDrive::spline(t, of(t, [](double x) { return 2 - 3 * x; }), 0.1);
  for (double x = 0; x <= 3; x += 0.1)
    EXPECT_NEAR(line.value(x, Side::right), 2 - 3 * x, 1e-11);

  std::vector<double> even;
  for (unsigned int i = 0; i <= 4000; ++i)
    even.push_back(i * 1e-3);
  for (const double ratio : {0.25, 1., 2.})
    {
      const double       f = 5 * ratio;
      const SampledDrive s = SampledDrive::spline(even, of(even, [f](double x) { return std::cos(2 * M_PI * f * x); }), 5);
      EXPECT_NEAR(s.value(2, Side::left) * std::cos(4 * M_PI * f), 1 / (1 + std::pow(ratio, 4)), 2e-3)
          << "Butterworth's gain at " << f << " Hz";
    }
}

TEST(SampledDrive, linesHaveSidesAndKinks)
{
  const SampledDrive s = SampledDrive::lines({0, 1, 3}, {1, 2, 0});
  EXPECT_EQ(s.value(2, Side::left), 1);
  EXPECT_EQ(s.first_derivative(1, Side::left), 1);
  EXPECT_EQ(s.first_derivative(1, Side::right), -1);
  EXPECT_EQ(s.kinks(0.5, 3), (std::vector<double>{1}));
  EXPECT_EQ(s.value(5, Side::left), 0);
  EXPECT_EQ(s.first_derivative(3, Side::right), 0);
}

TEST(Samples, columnsByName)
{
  const File    file("time, other ,length\n0,7,1\n0.1,8,2\r\n\n0.3,9,3\n");
  const Samples samples = read_samples(file.path, "time", {"length", "other"});
  EXPECT_EQ(samples.t, (std::vector<double>{0, 0.1, 0.3}));
  EXPECT_EQ(samples.x[0], (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(samples.x[1], (std::vector<double>{7, 8, 9}));
}

TEST(Samples, whatIsWrongIsNamed)
{
  const auto read = [](const std::string &text) {
    const File file(text);
    return complaint([&] { read_samples(file.path, "time", {"length"}); });
  };
  EXPECT_NE(read("time,lenght\n0,1\n1,1\n").find("nearest valid name: \"lenght\""), std::string::npos);
  EXPECT_NE(read("time,length\n0,1\n1,x\n").find("line 3"), std::string::npos);
  EXPECT_NE(read("time,length\n0,1\n1,nan\n").find("finite number"), std::string::npos);
  EXPECT_NE(read("time,length\n0,1\n1\n").find("has 1 fields"), std::string::npos);
  EXPECT_NE(read("time,length\n0,1\n0,1\n").find("ascend"), std::string::npos);
  EXPECT_NE(read("time,length\n0,1\n").find("fewer than two"), std::string::npos);
  EXPECT_NE(complaint([] { read_samples("there_is_no_such_file.csv", "t", {}); }).find("there is no such file"), std::string::npos);
}

// The gait from a file gives what the gait in closed form gives.
TEST(Samples, ofTheGaitMoveTheMuscleAsTheGaitDoes)
{
  std::ostringstream   text;
  const GaitLength     length(0.4122, 0.98, 1, 1.4);
  const GaitExcitation excitation(1.4);
  text.precision(15);
  text << "Time [s],length [m],excitation\n";
  for (double t = -0.1; t < 1.3; t += 0.002 + 0.0005 * std::sin(100 * t))
    text << t << "," << length.value(t, Side::left) << "," << excitation.value(t, Side::left) << "\n";
  const File file(text.str());
  const auto end = [&](const Overrides &input) {
    Overrides settings = unit_settings("mild", "1", "4");
    settings.insert(settings.end(), input.begin(), input.end());
    MuscleRun           run(read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), settings)), "ida", tolerances(1e-7, 1e-10, true));
    std::vector<double> result;
    run.go({1}, [&](const State &s) { result = {run.system.muscle_stretch(s.u), run.system.tendon_stretch(s.t, s.u)}; });
    return result;
  };
  const auto closed = end({}), sampled = end({"input/type=file", "input/file=" + file.path.string()});
  EXPECT_NEAR(sampled[0], closed[0], 2e-7);
  EXPECT_NEAR(sampled[1], closed[1], 2e-7);
}

TEST(Samples, thatCannotBeUsedAreRefused)
{
  const auto read = [](const std::string &text, const Overrides &more = {}) {
    const File file(text);
    Overrides  settings{"input/type=file", "input/file=" + file.path.string()};
    settings.insert(settings.end(), more.begin(), more.end());
    return complaint([&] { read_muscle_tendon_unit(node(muscle_tendon_unit_schema(), settings)); });
  };
  const std::string header = "Time [s],length [m],excitation\n";
  EXPECT_EQ(read(header + "0,0.4,0.1\n1,0.41,0.2\n"), "");
  EXPECT_NE(read(header + "0,0.4,0.1\n1,0.41,1.2\n").find("excitation of 1.2"), std::string::npos);
  EXPECT_NE(read(header + "0,0.4,0.1\n1,-0.41,0.2\n").find("lengths > 0"), std::string::npos);
  EXPECT_NE(read(header + "0.5,0.4,0.1\n1,0.41,0.2\n").find("begin after"), std::string::npos);
  EXPECT_NE(read(header + "0,0.4,0.1\n1,0.41,0.2\n", {"input/interpolation=linear", "input/cut-off frequency=3"}).find("do not smooth"),
            std::string::npos);
}
