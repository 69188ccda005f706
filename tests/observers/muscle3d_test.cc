// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: the files of a muscle run hold what their headers say. Homogeneous motions of a block, whose measures have closed forms.

#include "block.h"

TEST(MuscleOutputs, HomogeneousMotionHasItsClosedForms)
{
  Muscle3dParameters p = block();
  p.boundary           = {fixed("fixed end", 0), fixed("moving end", 1)};
  test::Folder         folder;
  WorkLedger           ledger;
  const Muscle3dSystem system(p, MPI_COMM_SELF, ledger);
  const auto           observers = make_outputs(output_scene(setting("all faces", "bool", "true") + setting("gearing", "bool", "true") +
                                                             setting("shape", "bool", "true") +
                                                             setting("markers", "string", "corner 0.03 0.01 0.02; middle 0.015 0.005 0.01")),
                                                system, folder.path, ledger);
  ASSERT_EQ(observers.size(), 1u);
  observers[0]->begin(homogeneous(system, 0, {}, {}));
  const State state = homogeneous(system, 0.1, {0.1, -0.03, -0.02}, {-2, 0.5, 0.25});
  observers[0]->accepted(state, step(1));

  const double J      = 1.1 * 0.97 * 0.98;
  const double V0     = 0.03 * 0.01 * 0.02;
  const double a[2]   = {1.1 * std::cos(pi / 6), 0.98 * std::sin(pi / 6)};
  const double da[2]  = {-2 * std::cos(pi / 6), 0.25 * std::sin(pi / 6)};
  const double lambda = std::hypot(a[0], a[1]);
  const double e      = (a[0] * da[0] + a[1] * da[1]) / lambda / 5;
  const double fibre  = std::min(0.03 / std::cos(pi / 6), 0.02 / std::sin(pi / 6));
  const double speed  = std::hypot(-2 * 0.015, 0.5 * 0.005, 0.25 * 0.01);
  const auto   near   = [](const std::vector<double> &row, const std::vector<double> &expected, const std::string &file) {
    ASSERT_EQ(row.size(), expected.size()) << file;
    for (std::size_t i = 0; i < row.size(); ++i)
      EXPECT_NEAR(row[i], expected[i], 1e-11 * std::abs(expected[i]) + 1e-16) << file << ", column " << i;
  };
  const auto row = [&](const std::string &file) { return test::numbers(folder.lines(file).at(2)); };

  near(row("mean_stretch_pennation_data-3d.csv"), {0.1, lambda, std::acos(a[0] / lambda) * 180 / pi, V0 / 4 * J}, "stretch");
  near(row("activation_muscle_length-3d.csv"), {0.1, 40, 0.033}, "activation");
  near(row("displacements-3d.csv"), {0.1, 0.003, -0.0003, -0.0004, 0.0015, -0.00015, -0.0002}, "displacements");
  near(row("gearing_info-3d.csv"), {0.1, -0.06, -0.03, 0.0025, 0.0025, speed, e, fibre, 5, fibre * 5 * e, V0 / 4 * J}, "gearing info");
  near(row("gearing.csv"), {0.1, -speed, fibre * 5 * e, -speed / (fibre * 5 * e), std::abs(e) <= 1 ? 1. : 0.}, "gearing");

  near(row("shape.csv"), {0.1, 0.033, 0.0097, 0.0196, J}, "shape");

  const std::vector<double> energy = row("energy_data-3d.csv");
  const double kinetic = 1060. / 2 * V0 * (4 * 0.03 * 0.03 + 0.25 * 0.01 * 0.01 + 0.0625 * 0.02 * 0.02) / 3; // int v^2 over the block
  EXPECT_NEAR(energy[1], kinetic / (J * V0), 1e-10 * energy[1]);
  EXPECT_NEAR(energy[8], J * V0, 1e-12 * V0);
  const std::vector<double> force = row("force_data-3d.csv");
  for (const std::vector<double> &parts :
       {std::vector<double>(energy.begin() + 2, energy.end()), std::vector<double>(force.begin() + 1, force.end())})
    {
      EXPECT_NEAR(parts[0], parts[1] + parts[2], 1e-9 * std::abs(parts[1]));
      EXPECT_NEAR(parts[2], parts[3] + parts[4] + parts[5], 1e-9 * std::abs(parts[5]));
    }

  // The stress is homogeneous, so opposite faces are pulled with opposite forces.
  const std::vector<std::string> faces = folder.lines("force_data-3d-001.csv");
  ASSERT_EQ(faces.size(), 7u);
  const std::vector<double> left = test::numbers(faces[1]), right = test::numbers(faces[2]);
  ASSERT_EQ(left.size(), 19u);
  EXPECT_EQ(left[0], 0);
  EXPECT_EQ(right[0], 1);
  EXPECT_EQ(right[1], force[1]);
  for (std::size_t i = 1; i < left.size(); ++i)
    EXPECT_NEAR(left[i], -right[i], 1e-9 * std::abs(right[1]));
}

TEST(MuscleOutputs, HeadersAreThoseOfFlexodeal)
{
  Muscle3dParameters p = block();
  p.boundary           = {fixed("moving end", 1), fixed("fixed end", 0)};
  test::Folder         folder;
  WorkLedger           ledger;
  const Muscle3dSystem system(p, MPI_COMM_SELF, ledger);
  make_outputs(output_scene(setting("markers", "string", "p1 0 0 0")), system, folder.path, ledger);
  const std::vector<std::pair<std::string, std::string>> headers{
      {"force_data-3d.csv",
       "Time [s],Total [N],Volumetric [N],Isochoric [N],Muscle active [N],Muscle passive [N],Muscle base [N],Volume [m^3]"},
      {"energy_data-3d.csv", "Time [s],Kinetic [J/m^3],Internal [J/m^3],Volumetric [J/m^3],Isochoric [J/m^3],Muscle active [J/m^3],Muscle "
                             "passive [J/m^3],Muscle base "
                             "[J/m^3],Volume [m^3]"},
      {"mean_stretch_pennation_data-3d.csv", "Time [s],Mean stretch,Mean pennation [deg],Volume slab [m^3]"},
      {"gearing_info-3d.csv",
       "Time [s],Prescribed velocity x [m/s],Mean muscle velocity x [m/s],Mean muscle velocity y [m/s],Mean muscle "
       "velocity z [m/s],Mean muscle "
       "velocity norm [m/s],Mean fibre strain rate (non-dim),Initial fibre length [m],Maximum strain rate [1/s],Mean "
       "fibre velocity [m/s],Volume "
       "slab [m^3]"},
      {"activation_muscle_length-3d.csv", "Time [s],Activation (%),Muscle length [m]"},
      {"displacements-3d.csv", "Time [s],p1_x [m],p1_y [m],p1_z [m]"},
      {"reaction.csv", "Time [s],moving end x [N],moving end y [N],moving end z [N],fixed end x [N],fixed end y [N],fixed end z [N],"
                       "moving end along the line [N],fixed end along the line [N]"}};
  for (const auto &[file, header] : headers)
    EXPECT_EQ(folder.lines(file).at(0), header);
}

/// Every series, asked for as its parameter goes; those of parameters that are no switch are the two of this test.
TEST(MuscleOutputs, EverySeriesHasATitle)
{
  Muscle3dParameters p = block();
  p.boundary           = {fixed("moving end", 1), fixed("fixed end", 0)};
  test::Folder         folder;
  WorkLedger           ledger;
  const Muscle3dSystem system(p, MPI_COMM_SELF, ledger);
  const OutputFolder   outputs(folder.path);
  std::string          all = setting("markers", "string", "p1 0 0 0") + setting("fascicles", "int", "3");
  scene::Schema        declared("");
  for (const SeriesEntry &entry : series_registry())
    entry.declare(declared);
  for (const scene::Entry &entry : declared.entries())
    if (entry.kind == scene::Kind::boolean)
      all += setting(entry.name, "bool", "true");
  make_outputs(output_scene(all + setting("strain places", "string", "1")), system, outputs, ledger);
  EXPECT_GT(outputs.noted().size(), 12u);
  for (const std::string &file : outputs.noted())
    if (file.find('*') == std::string::npos) // those have no time
      EXPECT_EQ(outputs.titles().count(file), 1u) << file;
}

TEST(MuscleOutputs, MeasuresOnceAndOnlyWhatIsAskedFor)
{
  Muscle3dParameters p = block();
  p.boundary           = {fixed("fixed end", 0)};
  test::Folder         folder;
  WorkLedger           ledger;
  const Muscle3dSystem system(p, MPI_COMM_SELF, ledger);

  std::string nothing;
  for (const char *name :
       {"forces", "reactions", "energies", "energy balance", "stretch and pennation", "gearing info", "activation and length"})
    nothing += setting(name, "bool", "false");
  const auto silent = make_outputs(output_scene(nothing), system, folder.path, ledger);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
  silent[0]->begin(homogeneous(system, 0, {}, {}));
  EXPECT_EQ(ledger.counted("residual evaluations"), 0u);

  // Reactions and the energy balance both need the residual: one evaluation serves them.
  const auto usual = make_outputs(output_scene(""), system, folder.path, ledger);
  usual[0]->begin(homogeneous(system, 0, {}, {}));
  EXPECT_EQ(ledger.counted("residual evaluations"), 1u);
  EXPECT_EQ(ledger.counted("field outputs"), 0u);
  EXPECT_FALSE(is_there(folder, "fields.pvd"));
}

TEST(MuscleOutputs, RareRowsCostOnlyWhenWritten)
{
  Muscle3dParameters p = block();
  p.boundary           = {fixed("fixed end", 0)};
  test::Folder         folder;
  WorkLedger           ledger;
  const Muscle3dSystem system(p, MPI_COMM_SELF, ledger);
  const auto           run = [&](const std::string &series) {
    const auto before    = ledger.counts();
    const auto observers = make_outputs(output_scene(setting("every", "int", "3") + series), system, folder.path, ledger);
    observers[0]->begin(homogeneous(system, 0, {}, {}));
    for (std::size_t i = 1; i <= 5; ++i)
      observers[0]->accepted(homogeneous(system, 0.1 * i, {0.01 * i, 0, 0}, {0.1, 0, 0}), step(i));
    observers[0]->last(homogeneous(system, 0.5, {0.05, 0, 0}, {0.1, 0, 0}));
    std::map<std::string, std::uint64_t> counts;
    for (const auto &[what, times] : ledger.counts())
      counts[what] = times - (before.count(what) ? before.at(what) : 0);
    return counts;
  };

  // Rows at steps 0, 3 and 5, the last one; between them nothing is measured ...
  const auto without = run(setting("energy balance", "bool", "false"));
  EXPECT_EQ(test::numbers(folder.lines("reaction.csv").back())[0], 0.5);
  EXPECT_EQ(folder.lines("reaction.csv").size(), 4u);
  EXPECT_EQ(without.at("body measurements"), 3u);
  EXPECT_EQ(without.at("reaction measurements"), 3u);
  EXPECT_EQ(without.at("residual evaluations"), 3u);
  EXPECT_EQ(without.at("face force measurements"), 3u);
  EXPECT_EQ(without.count("power measurements"), 0u);
  // ... but powers and reactions, if the energy balance integrates them: steps 1, 2, 4, and 5 before it proves the last.
  auto with = run("");
  EXPECT_EQ(with["body measurements"], 3u);
  EXPECT_EQ(with["reaction measurements"], 7u);
  EXPECT_EQ(with["face force measurements"], 3u);
  EXPECT_EQ(with["power measurements"], 4u);
}

TEST(MuscleOutputs, AResumedRunLeavesTheSameFiles)
{
  Muscle3dParameters p = block();
  p.boundary           = {fixed("fixed end", 0)};
  WorkLedger           ledger;
  const Muscle3dSystem system(p, MPI_COMM_SELF, ledger);
  const auto           at    = [&](const std::size_t i) { return homogeneous(system, 0.1 * i, {0.01 * i, 0, 0}, {0.1 + 0.02 * i, 0, 0}); };
  const scene::Node    scene = output_scene(setting("every", "int", "3") + setting("all faces", "bool", "true"),
                                            "<ParameterList name=\"fields\">" + setting("every", "int", "2") + "</ParameterList>");
  using Outputs              = std::vector<std::unique_ptr<Observer>>;
  const auto steps           = [&](const Outputs &outputs, const std::size_t first, const std::size_t end) {
    for (std::size_t i = first; i < end; ++i)
      for (const auto &output : outputs)
        output->accepted(at(i), step(i));
  };
  const auto last = [&](const Outputs &outputs, const std::size_t i) {
    for (const auto &output : outputs)
      output->last(at(i));
  };

  test::Folder  whole, part;
  const Outputs of_whole = make_outputs(scene, system, whole.path, ledger);
  Archive       saved;
  {
    const Outputs outputs = make_outputs(scene, system, part.path, ledger);
    for (const Outputs *both : {&of_whole, &outputs})
      for (const auto &output : *both)
        output->begin(at(0));
    steps(of_whole, 1, 9);
    last(of_whole, 8);
    steps(outputs, 1, 5);
    for (const auto &output : outputs)
      output->save(saved);
    last(outputs, 4); // a row that the resumed run takes back
    EXPECT_TRUE(is_there(part, "force_data-3d-004.csv"));
  }
  const Outputs resumed = make_outputs(scene, system, OutputFolder(part.path, &saved), ledger);
  for (const auto &output : resumed)
    output->resume(at(4), 4);
  steps(resumed, 5, 9);
  last(resumed, 8);

  EXPECT_FALSE(is_there(part, "force_data-3d-004.csv"));
  std::size_t files = 0;
  for (const auto &entry : std::filesystem::directory_iterator(whole.path))
    {
      const std::string name = entry.path().filename().string();
      ASSERT_TRUE(is_there(part, name)) << name;
      if (entry.path().extension() != ".vtu") // they tell the time of day
        {
          EXPECT_EQ(whole.text(name), part.text(name)) << name;
        }
      --files;
    }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(part.path), {}), -static_cast<std::ptrdiff_t>(files));
}

TEST(MuscleOutputs, FieldsAndTheirCollection)
{
  test::Folder         folder;
  WorkLedger           ledger;
  const Muscle3dSystem system(block(), MPI_COMM_SELF, ledger);
  const auto           observers = make_outputs(output_scene("", "<ParameterList name=\"fields\">" + setting("every", "int", "2") +
                                                                     setting("what", "string", "displacement, pressure") + "</ParameterList>"),
                                                system, folder.path, ledger);
  ASSERT_EQ(observers.size(), 2u);
  observers[1]->begin(homogeneous(system, 0, {}, {}));
  EXPECT_EQ(folder.text("fields.pvd").find("fields-0001"), std::string::npos);
  observers[1]->accepted(homogeneous(system, 0.1, {0.01, 0, 0}, {}), step(1));
  observers[1]->accepted(homogeneous(system, 0.2, {0.02, 0, 0}, {}), step(2));
  EXPECT_TRUE(is_there(folder, "fields-0000.vtu"));
  EXPECT_TRUE(is_there(folder, "fields-0001.vtu"));
  EXPECT_FALSE(is_there(folder, "fields-0002.vtu"));
  EXPECT_NE(folder.text("fields.pvd").find("timestep=\"0.2\" group=\"\" part=\"0\" file=\"fields-0001.vtu\""), std::string::npos);
  const std::string fields = folder.text("fields-0001.vtu");
  EXPECT_NE(fields.find("Name=\"displacement\""), std::string::npos);
  EXPECT_NE(fields.find("Name=\"pressure\""), std::string::npos);
  EXPECT_EQ(fields.find("Name=\"velocity\""), std::string::npos);
}

TEST(MuscleOutputs, QuasiStaticScenesHaveNoVelocities)
{
  Muscle3dParameters p = block();
  p.dynamic            = false;
  test::Folder         folder;
  WorkLedger           ledger;
  const Muscle3dSystem system(p, MPI_COMM_SELF, ledger);
  make_outputs(output_scene(""), system, folder.path, ledger);
  EXPECT_TRUE(is_there(folder, "force_data-3d.csv"));
  EXPECT_FALSE(is_there(folder, "gearing_info-3d.csv"));
  EXPECT_FALSE(is_there(folder, "energy_balance.csv"));
  EXPECT_THROW(make_outputs(output_scene(setting("gearing", "bool", "true")), system, folder.path, ledger), InputError);
}

TEST(MuscleOutputs, AMarkerOutsideTheBodyIsNamed)
{
  test::Folder         folder;
  WorkLedger           ledger;
  const Muscle3dSystem system(block(), MPI_COMM_SELF, ledger);
  try
    {
      make_outputs(output_scene(setting("markers", "string", "inside 0 0 0; far 1 0 0")), system, folder.path, ledger);
      FAIL() << "a marker outside the body was accepted";
    }
  catch (const InputError &error)
    {
      EXPECT_NE(error.problems()[0].what.find("\"far\""), std::string::npos);
      EXPECT_NE(error.problems()[0].where.find("series/markers"), std::string::npos) << error.problems()[0].where;
    }
}
