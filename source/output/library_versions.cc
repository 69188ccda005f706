// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/output/version.h>

#include <deal.II/base/config.h>

#include <hdf5.h>
#include <mpi.h>
#include <zlib.h>

namespace myolines
{
  namespace
  {
    std::string dotted(const unsigned int major, const unsigned int minor, const unsigned int patch)
    {
      return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
    }

    std::string mpi_version()
    {
      char text[MPI_MAX_LIBRARY_VERSION_STRING];
      int  length = 0;
      MPI_Get_library_version(text, &length);
      const std::string all(text, length);
      return all.substr(0, all.find_first_of(",\n"));
    }

    std::string hdf5_version()
    {
      unsigned int major = 0, minor = 0, patch = 0;
      H5get_libversion(&major, &minor, &patch);
      return dotted(major, minor, patch);
    }
  } // namespace

  Versions library_versions()
  {
    return {{"deal.II", DEAL_II_PACKAGE_VERSION},
            {"Trilinos", dotted(DEAL_II_TRILINOS_VERSION_MAJOR, DEAL_II_TRILINOS_VERSION_MINOR, DEAL_II_TRILINOS_VERSION_SUBMINOR)},
            {"p4est", dotted(DEAL_II_P4EST_VERSION_MAJOR, DEAL_II_P4EST_VERSION_MINOR, DEAL_II_P4EST_VERSION_SUBMINOR)},
            {"MPI", mpi_version()},
            {"HDF5", hdf5_version()},
            {"zlib", zlibVersion()}};
  }

  const char *build_type()
  {
#ifdef DEBUG
    return "Debug";
#else
    return "Release";
#endif
  }
} // namespace myolines
