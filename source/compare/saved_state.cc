// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/compare/compare.h>
#include <myolines/output/checkpoint.h>
#include <myolines/output/text_file.h>
#include <myolines/scene/node_builder.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace myolines
{
  namespace
  {
    const std::vector<std::string> &comparable()
    {
      static const std::vector<std::string> types{"muscle 3d", "rod 1d"};
      return types;
    }

    /// The list `system` of a whole scene, as text of every value in force.
    scene::Node system_of(const std::string &scene, const std::string &file)
    {
      std::vector<InputProblem> problems;
      const scene::RawList      root = scene::parse_document(scene, file, problems);
      const auto  found              = std::find_if(root.lists.begin(), root.lists.end(), [](const auto &l) { return l.name == "system"; });
      const auto *type               = scene::find_parameter(root, "system/type");
      if (!problems.empty() || type == nullptr)
        throw InputError(InputProblem{file, "the scene in it cannot be read", "a state that this version of the program wrote", ""});
      if (std::find(comparable().begin(), comparable().end(), type->text) == comparable().end())
        throw InputError(InputProblem{file, "it is of a system \"" + type->text + "\", which has no fields", "a run of muscle 3d or rod 1d",
                                      "its time series can be drawn together: myolines plot DIR DIR"});
      const scene::Schema schema =
          scene::Schema("What is computed.")
              .variant("type", std::nullopt, {{"muscle 3d", muscle3d_schema()}, {"rod 1d", rod1d_schema()}}, "Kind of system.");
      scene::Node node = scene::NodeBuilder(file, "/", problems).build(&*found, schema, "system", "system");
      if (!problems.empty())
        throw InputError(problems);
      return node;
    }

    [[noreturn]] void refuse_pair(const SavedState &first, const SavedState &second, const std::string &what, const std::string &expected)
    {
      throw InputError(InputProblem{first.file().string() + " and " + second.file().string(), what, expected, ""});
    }

    std::string text_of(const std::array<double, 3> &size)
    {
      return exact_text(size[0]) + " x " + exact_text(size[1]) + " x " + exact_text(size[2]) + " m";
    }

    bool equal(const double x, const double y) { return std::abs(x - y) <= 1e-12 * std::max(std::abs(x), std::abs(y)); }
  } // namespace

  struct SavedState::Rod
  {
    Rod(const scene::Node &node, const CheckpointReader &reader)
      : system(read_rod1d(node), ledger)
      , state(reader.read(system).state)
    {}

    WorkLedger  ledger;
    Rod1dSystem system;
    State       state;
  };

  SavedState::SavedState(const std::filesystem::path &file)
    : file_(file)
  {
    const CheckpointReader reader(file);
    const scene::Node      system = system_of(reader.contents().scene, file.string());
    t_                            = reader.contents().state.t;
    if (system.text("type") == "rod 1d")
      {
        rod_ = std::make_unique<const Rod>(system, reader);
        return;
      }
    const Muscle3dParameters parameters = read_muscle3d(system);
    if (parameters.geometry.gastrocnemius || parameters.geometry.mesh || parameters.geometry.distortion > 0)
      throw InputError(
          InputProblem{file.string(),
                       "its body is of geometry \"" + system.section("geometry").text("type") +
                           "\", and fields are compared on blocks of equal cells alone",
                       "runs of a block without distortion, or of a rod",
                       "quantities of a study compare the tables of any runs (\"column\"), and unknowns on one mesh (\"state\")"});
    WorkLedger           ledger;
    const Muscle3dSystem muscle(parameters, MPI_COMM_SELF, ledger);
    muscle_ = std::make_unique<const BlockFields>(muscle, reader.read(muscle).state);
  }

  SavedState::~SavedState() = default;

  std::vector<FieldDifference> l2_differences(const SavedState &first, const SavedState &second)
  {
    if ((first.rod_ == nullptr) != (second.rod_ == nullptr))
      refuse_pair(first, second, "one is of a muscle and the other of a rod", "two of the same kind of system");
    if (first.rod_)
      {
        const double one = first.rod_->system.parameters().length, other = second.rod_->system.parameters().length;
        if (!equal(one, other))
          refuse_pair(first, second, "the rods are " + exact_text(one) + " m and " + exact_text(other) + " m long", "rods of equal length");
        return l2_differences(first.rod_->system, first.rod_->state, second.rod_->system, second.rod_->state);
      }
    for (unsigned int d = 0; d < 3; ++d)
      if (!equal(first.muscle_->size()[d], second.muscle_->size()[d]))
        refuse_pair(first, second, "the blocks measure " + text_of(first.muscle_->size()) + " and " + text_of(second.muscle_->size()),
                    "blocks of equal size; meshes and degrees may differ");
    return l2_differences(*first.muscle_, *second.muscle_, MPI_COMM_WORLD);
  }
} // namespace myolines
