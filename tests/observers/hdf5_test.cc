// SPDX-License-Identifier: LGPL-2.1-or-later
// Requirement: HDF5 files hold what the state holds, at the points where it holds. Homogeneous motions, which have closed forms.

#include <myolines/base/error.h>
#include <myolines/fem/node_space.h>
#include <myolines/muscle3d/discretisation.h>
#include <myolines/observers/outputs.h>

#include "../output/folder.h"

#include <deal.II/base/hdf5.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <cmath>
#include <fstream>

using namespace myolines;

namespace
{
  /// 3 x 1 x 2 cm, u = 0.1 X in the first component and -0.02 Z in the third, v = -2 X in the first.
  struct Stretched
  {
    Stretched()
      : system(parameters(), MPI_COMM_SELF, ledger)
      , state(system.initial_state(0.25))
    {
      const NodeSpace &space = *system.discretisation().space;
      for (Vector *x : {&state.u, &state.v})
        x->zero_out_ghost_values();
      for (unsigned int node = 0; node < system.n_unknowns() / 3; ++node)
        {
          state.u(3 * node)     = 0.1 * space.node_position(node)[0];
          state.u(3 * node + 2) = -0.02 * space.node_position(node)[2];
          state.v(3 * node)     = -2 * space.node_position(node)[0];
        }
    }

    static Muscle3dParameters parameters()
    {
      Muscle3dParameters p;
      p.geometry.size            = {{0.03, 0.01, 0.02}};
      p.geometry.cells           = {{3, 1, 2}};
      p.geometry.refinement      = 1;
      p.n_points                 = 3;
      p.muscle().fibre.direction = {{0.8, 0, 0.6}};
      return p;
    }

    /// Writes once what the output list @p name with @p what asks for.
    void write(const std::string &list, const std::string &what, const std::string &more = "")
    {
      const std::string xml = "<ParameterList name=\"scene\"><ParameterList name=\"" + list +
                              "\"><Parameter name=\"what\" type=\"string\" value=\"" + what + "\"/>" + more +
                              "</ParameterList></ParameterList>";
      make_outputs(scene::parse_scene(xml, muscle3d_output_schema()), system, folder.path, ledger).at(1)->begin(state);
    }

    dealii::Vector<double> list(const std::string &file, const std::string &name) const
    {
      dealii::HDF5::File hdf5((folder.path / file).string(), dealii::HDF5::File::FileAccessMode::open);
      return hdf5.open_dataset(name).read<dealii::Vector<double>>();
    }

    dealii::FullMatrix<double> table(const std::string &file, const std::string &name) const
    {
      dealii::HDF5::File hdf5((folder.path / file).string(), dealii::HDF5::File::FileAccessMode::open);
      return hdf5.open_dataset(name).read<dealii::FullMatrix<double>>();
    }

    test::Folder   folder;
    WorkLedger     ledger;
    Muscle3dSystem system;
    State          state;
  };
} // namespace

TEST(QuadratureTables, HoldTheStateAtEveryPoint)
{
  Stretched body;
  body.write("quadrature", "all");
  const std::string file     = "quadrature-0000.h5";
  const auto        column   = [&](const std::string &name) { return body.list(file, name); };
  const std::size_t n_points = 48 * 27;
  const double      F1 = 1.1, F3 = 0.98, J = F1 * F3;
  const double      stretch = std::hypot(F1 * 0.8, F3 * 0.6);
  const auto        X = column("qp_x"), Z = column("qp_z");
  ASSERT_EQ(X.size(), n_points);
  for (std::size_t i = 0; i < n_points; ++i)
    ASSERT_TRUE(X(i) > 0 && X(i) < 0.03 && Z(i) > 0 && Z(i) < 0.02);

  const auto near = [&](const std::string &name, const std::function<double(std::size_t)> &expected, const double scale) {
    const auto values = column(name);
    ASSERT_EQ(values.size(), n_points) << name;
    for (std::size_t i = 0; i < n_points; ++i)
      ASSERT_NEAR(values(i), expected(i), 1e-12 * scale) << name << ", point " << i;
  };
  const auto constant = [](const double value) { return [value](std::size_t) { return value; }; };
  near("det_F", constant(J), 1);
  near("D", constant(J), 1);
  near(
      "u1", [&](const std::size_t i) { return 0.1 * X(i); }, 0.003);
  near("u2", constant(0), 0.003);
  near(
      "u3", [&](const std::size_t i) { return -0.02 * Z(i); }, 0.003);
  near(
      "v1", [&](const std::size_t i) { return -2 * X(i); }, 0.06);
  near("stretch", constant(stretch), 1);
  near("stretch_bar", constant(stretch / std::cbrt(J)), 1);
  near("strain_rate", constant(F1 * 0.8 * -2 * 0.8 / stretch / 5), 1);
  near("orientation_x", constant(F1 * 0.8), 1);
  near("orientation_z", constant(F3 * 0.6), 1);
  near("p", constant(body.system.parameters().muscle().bulk_modulus / 2 * (J - 1 / J)), 1e7);
  double volume = 0;
  for (const double JxW : column("JxW"))
    volume += JxW;
  EXPECT_NEAR(volume, 0.03 * 0.01 * 0.02, 1e-18);

  dealii::HDF5::File hdf5((body.folder.path / file).string(), dealii::HDF5::File::FileAccessMode::open);
  EXPECT_EQ(hdf5.get_attribute<double>("Time [s]"), 0.25);
  EXPECT_EQ(hdf5.open_dataset("v1").get_attribute<std::string>("unit"), "m/s");
}

// Binary files of Flexodeal beside the same points in HDF5; its tensors: F, and a Kirchhoff stress that is the sum of its parts.
TEST(QuadratureTables, HaveTheFormatOfFlexodeal)
{
  Stretched body;
  body.write("quadrature", "all");
  body.write("quadrature", "all", "<Parameter name=\"format\" type=\"string\" value=\"flexodeal\"/>");
  const auto read = [&](const std::string &name) {
    std::ifstream      stream(body.folder.path / name, std::ios::binary);
    std::vector<float> values(std::filesystem::file_size(body.folder.path / name) / sizeof(float));
    stream.read(reinterpret_cast<char *>(values.data()), values.size() * sizeof(float));
    return values;
  };
  const std::size_t        n_points = 48 * 27, n_main = 21, n_tensors = 69;
  const std::vector<float> main = read("cell_data_main-3d-000.data"), tensors = read("cell_data_tensors-3d-000.data");
  ASSERT_EQ(main.size(), n_main * n_points);
  ASSERT_EQ(tensors.size(), n_tensors * n_points);
  const std::vector<std::string> columns{"qp_x",
                                         "qp_y",
                                         "qp_z",
                                         "JxW",
                                         "det_F",
                                         "u1",
                                         "u2",
                                         "u3",
                                         "v1",
                                         "v2",
                                         "v3",
                                         "p",
                                         "D",
                                         "stretch",
                                         "stretch_bar",
                                         "strain_rate",
                                         "strain_rate_bar",
                                         "orientation_x",
                                         "orientation_y",
                                         "orientation_z"};
  for (std::size_t c = 0; c < columns.size(); ++c)
    {
      const auto values = body.list("quadrature-0000.h5", columns[c]);
      for (std::size_t i = 0; i < n_points; ++i)
        ASSERT_EQ(main[n_main * i + c], static_cast<float>(values(i))) << columns[c] << ", point " << i;
    }
  for (std::size_t i = 0; i < n_points; ++i)
    {
      const float *row = &tensors[n_tensors * i];
      ASSERT_NEAR(row[5], 1.1, 1e-6);
      ASSERT_NEAR(row[6], 0, 1e-12);
      ASSERT_NEAR(row[13], 0.98, 1e-6);
      for (unsigned int k = 0; k < 9; ++k)
        {
          const double scale = 1e-5 * std::abs(row[14]);
          ASSERT_NEAR(row[14 + k], row[23 + k] + row[32 + k], scale);
          ASSERT_NEAR(row[32 + k], row[41 + k] + row[50 + k] + row[59 + k], scale);
        }
      ASSERT_EQ(row[68], 1);
      ASSERT_EQ(main[n_main * i + 20], 1);
    }
}

TEST(QuadratureTables, HoldOnlyTheColumnsAskedFor)
{
  Stretched body;
  body.write("quadrature", "p, JxW");
  EXPECT_EQ(body.list("quadrature-0000.h5", "p").size(), 48u * 27);
  EXPECT_LT(std::filesystem::file_size(body.folder.path / "quadrature-0000.h5"), 3 * 48 * 27 * sizeof(double));
  EXPECT_EQ(body.ledger.counted("quadrature outputs"), 1u);
  try
    {
      body.write("quadrature", "qp_x, stretchbar");
      FAIL() << "an unknown column was accepted";
    }
  catch (const InputError &error)
    {
      EXPECT_NE(error.problems()[0].what.find("\"stretchbar\""), std::string::npos);
      EXPECT_EQ(error.problems()[0].hint, "nearest: \"stretch_bar\"");
    }
}

TEST(Hdf5Fields, ArePointByPointTheState)
{
  Stretched body;
  body.write("fields", "displacement, stretch", "<Parameter name=\"format\" type=\"string\" value=\"hdf5\"/>");
  const auto points = body.table("fields-mesh-0000.h5", "nodes"), u = body.table("fields-0000.h5", "displacement"),
             stretch = body.table("fields-0000.h5", "stretch");
  ASSERT_EQ(points.m(), 48u * 27);
  ASSERT_EQ(u.m(), points.m());
  ASSERT_EQ(stretch.m(), points.m());
  for (unsigned int i = 0; i < points.m(); ++i)
    {
      ASSERT_NEAR(u(i, 0), 0.1 * points(i, 0), 1e-9) << "single precision";
      ASSERT_NEAR(u(i, 2), -0.02 * points(i, 2), 1e-9);
      ASSERT_NEAR(stretch(i, 0), std::hypot(1.1 * 0.8, 0.98 * 0.6), 1e-6);
    }
  const std::string xdmf = body.folder.text("fields.xdmf");
  for (const char *part : {"<Time Value=\"0.25\"/>", "fields-mesh-0000.h5:/nodes", "fields-0000.h5:/displacement",
                           "fields-0000.h5:/stretch", "Dimensions=\"1296 3\"", "NumberOfElements=\"384\""})
    EXPECT_NE(xdmf.find(part), std::string::npos) << part;
}
