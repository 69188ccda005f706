// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/observers/muscle3d_series.h>

namespace myolines
{
#define MYOLINES_MUSCLE3D_SERIES(name) SeriesEntry name##_series();
#include "../../outputs/list.def"
#undef MYOLINES_MUSCLE3D_SERIES

  Registry<SeriesEntry> &series_registry()
  {
    static Registry<SeriesEntry> registry("series", {
#define MYOLINES_MUSCLE3D_SERIES(name) name##_series(),
#include "../../outputs/list.def"
#undef MYOLINES_MUSCLE3D_SERIES
                                                    });
    return registry;
  }

  SeriesEntry switched_series(const std::string &name, const bool default_on, const SeriesNeeds needs, const std::string &doc,
                              std::function<std::unique_ptr<SeriesFile>(const SeriesContext &)> make)
  {
    return {name,
            default_on,
            needs,
            [=](scene::Schema &series) { series.boolean(name, default_on, doc); },
            [=](const scene::Node &series) { return series.boolean(name); },
            std::move(make)};
  }

  namespace
  {
    class FunctionFile : public SeriesFile
    {
    public:
      FunctionFile(const OutputFolder &folder, const TableName &name, const std::vector<std::string> &columns,
                   std::function<std::vector<double>(const Muscle3dSample &)> values)
        : csv_(folder, name, columns)
        , values_(std::move(values))
      {}

      void row(const Muscle3dSample &sample, std::size_t) override { csv_.row(values_(sample)); }
      void save(Archive &archive) const override { csv_.save(archive); }

    private:
      CsvFile                                                    csv_;
      std::function<std::vector<double>(const Muscle3dSample &)> values_;
    };

    /// Whether the body has what @p entry needs. @throws InputError if not, where it must have been asked for.
    bool has_needs(const SeriesEntry &entry, const SeriesContext &context)
    {
      const bool all = entry.needs == SeriesNeeds::velocities_and_line;
      if ((all || entry.needs == SeriesNeeds::velocities) && !context.system.parameters().dynamic)
        {
          if (!entry.default_on)
            context.series.refuse(entry.name, "a quasi-static system has no velocities", "false, or \"dynamic\" as system/inertia");
          return false;
        }
      if ((all || entry.needs == SeriesNeeds::line) && !context.system.line_of_action().line)
        {
          if (!entry.default_on)
            context.series.refuse(entry.name, "the body has no line of action: " + context.system.line_of_action().why_none,
                                  "a list \"line of action\" in \"system\", with two faces \"from\" and \"to\"");
          return false;
        }
      return true;
    }
  } // namespace

  std::unique_ptr<SeriesFile> make_series_file(const OutputFolder &folder, const TableName &name, const std::vector<std::string> &columns,
                                               std::function<std::vector<double>(const Muscle3dSample &)> values)
  {
    return std::make_unique<FunctionFile>(folder, name, columns, std::move(values));
  }

  std::vector<std::unique_ptr<SeriesFile>> make_series(const SeriesContext &context)
  {
    std::vector<std::unique_ptr<SeriesFile>> files;
    for (const SeriesEntry &entry : series_registry())
      if (entry.wanted(context.series) && has_needs(entry, context))
        if (auto file = entry.make(context))
          files.push_back(std::move(file));
    return files;
  }
} // namespace myolines
