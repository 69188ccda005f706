// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/output/output_folder.h>
#include <myolines/output/text_file.h>

#include <stdexcept>

namespace myolines
{
  OutputFolder::OutputFolder(std::filesystem::path folder, const Archive *saved_outputs)
    : path(std::move(folder))
    , saved(saved_outputs)
    , list_(std::make_shared<List>())
  {}

  OutputFolder OutputFolder::with_foreign_files(std::filesystem::path folder)
  {
    OutputFolder made(std::move(folder));
    made.list_->spares_others = true;
    return made;
  }

  OutputFolder OutputFolder::nowhere()
  {
    OutputFolder made("");
    made.list_->nowhere = true;
    return made;
  }

  OutputFolder OutputFolder::read_by(RowReader reader)
  {
    OutputFolder made  = nowhere();
    made.list_->reader = std::move(reader);
    return made;
  }

  std::filesystem::path OutputFolder::file(const std::string &name) const
  {
    note(name);
    return path / name;
  }

  std::shared_ptr<File> OutputFolder::open(const std::string &name, const File::Mode mode) const
  {
    const std::filesystem::path place = file(name);
    if (list_->nowhere || !writes_files())
      return nullptr;
    list_->open.push_back(std::make_shared<File>(place, mode));
    return list_->open.back();
  }

  void OutputFolder::close() const
  {
    for (const std::shared_ptr<File> &file : list_->open)
      file->close();
  }

  void OutputFolder::note(const std::string &pattern) const
  {
    if (list_->spares_others && list_->names.count(pattern) == 0)
      on_writing_rank(path.string(), "a folder for the results of this run alone", "choose another one with --out", [&] {
        const std::filesystem::path inside = std::filesystem::path(pattern).parent_path();
        if (std::filesystem::is_directory(path / inside))
          for (const auto &entry : std::filesystem::directory_iterator(path / inside))
            if (const std::string name = (inside / entry.path().filename()).string(); matches(name, pattern))
              throw std::runtime_error("the file " + name +
                                       " there is not of an earlier run of this program, and the run would overwrite it");
      });
    list_->names.insert(pattern);
  }

  bool matches(const std::string &name, const std::string &pattern)
  {
    const std::size_t star = pattern.find('*');
    if (star == std::string::npos)
      return name == pattern;
    const std::size_t behind = pattern.size() - star - 1;
    return name.size() > star + behind && name.compare(0, star, pattern, 0, star) == 0 &&
           name.compare(name.size() - behind, behind, pattern, star + 1, behind) == 0 &&
           name.substr(star, name.size() - star - behind).find_first_not_of("0123456789.") == std::string::npos;
  }
} // namespace myolines
