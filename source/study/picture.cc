// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/output/text_file.h>
#include <myolines/study/picture.h>
#include <myolines/study/processes.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace myolines::study
{
  namespace
  {
    const std::vector<std::string> colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
    const std::vector<int>         marks{5, 7, 9, 11, 13, 4, 6, 8, 10, 12}; // filled, then open

    /// In quotes for gnuplot.
    std::string quoted(const std::string &text)
    {
      std::string result = "'";
      for (const char c : text)
        result += c == '\'' ? std::string("''") : std::string(1, c == '\n' ? ' ' : c);
      return result + "'";
    }

    bool drawable(const Picture &picture, const std::pair<double, double> &point)
    {
      const auto [x, y] = point;
      return std::isfinite(x) && std::isfinite(y) && !(picture.log_x && x <= 0) && !(picture.log_y && y <= 0);
    }

    /// Names of data blocks begin with @p block.
    void write_data(const Picture &picture, const std::string &block, std::ostream &out)
    {
      for (std::size_t i = 0; i < picture.curves.size(); ++i)
        {
          out << "$" << block << i << " << EOD\n";
          for (const auto &point : picture.curves[i].points)
            if (drawable(picture, point))
              out << exact_text(point.first) << " " << exact_text(point.second) << "\n";
          out << "EOD\n";
        }
    }

    void write_words(const std::string &axis, const std::vector<std::pair<double, std::string>> &words, std::ostream &out)
    {
      if (words.empty())
        return;
      const bool crowded = axis == "x" && words.size() > 6;
      out << "set " << axis << "tics " << (crowded ? "rotate by 50 right (" : "(");
      for (std::size_t i = 0; i < words.size(); ++i)
        out << (i > 0 ? ", " : "") << quoted(words[i].second) << " " << exact_text(words[i].first);
      out << ")\n";
    }

    void write_plot(const Picture &picture, const std::string &block, std::ostream &out)
    {
      std::string separator = "plot ";
      for (std::size_t i = 0; i < picture.curves.size(); ++i)
        {
          const Curve &curve = picture.curves[i];
          bool         empty = true;
          for (const auto &point : curve.points)
            empty = empty && !drawable(picture, point);
          if (empty) // gnuplot would refuse the whole picture
            continue;
          const std::string style = picture.lines && picture.marks ? "linespoints" : picture.lines ? "lines" : "points";
          out << separator << "$" << block << i << " using 1:2 with " << style << " lc rgb '" << colours[i % colours.size()] << "'";
          if (picture.lines) // where there are no marks, dashes tell curves apart
            out << " dt " << 1 + (picture.marks ? i / colours.size() : i) % 5 << " lw 1.5";
          if (picture.marks)
            out << " pt " << marks[i % marks.size()] << " ps " << (picture.lines ? "0.9" : "2");
          out << " title " << quoted(curve.title);
          separator = ", \\\n     ";
        }
      out << "\n";
    }

    void write_frame(const Picture &picture, std::ostream &out)
    {
      out << "set title " << quoted(picture.title) << "\nset xlabel " << quoted(picture.x_label) << "\nset ylabel "
          << quoted(picture.y_label) << "\nset grid lc rgb '#CCCCCC'\n"
          << (picture.marks ? "set offsets graph 0.03, graph 0.03, graph 0.05, graph 0.05\n" : "set autoscale xfix\n");
      for (const auto &[axis, logarithmic] : {std::pair<const char *, bool>{"x", picture.log_x}, {"y", picture.log_y}})
        out << (logarithmic ? std::string("set logscale ") + axis + "\n" : "") << "set format " << axis << " '%g'\n";
      write_words("x", picture.x_words, out);
      write_words("y", picture.y_words, out);
    }

    /// Panels are too narrow for the labels that gnuplot chooses: at most five steps of 1, 2 or 5 times a power of ten.
    void write_few_ticks(const Picture &panel, std::ostream &out)
    {
      if (panel.log_x || !panel.x_words.empty())
        return;
      double first = std::numeric_limits<double>::infinity(), last = -first;
      for (const Curve &curve : panel.curves)
        for (const auto &point : curve.points)
          if (drawable(panel, point))
            {
              first = std::min(first, point.first);
              last  = std::max(last, point.first);
            }
      if (!(last > first))
        return;
      const double power = std::pow(10, std::floor(std::log10((last - first) / 5)));
      for (const double step : {power, 2 * power, 5 * power, 10 * power})
        if (last - first <= 5 * step)
          {
            out << "set xtics " << exact_text(step) << "\n";
            return;
          }
    }

    std::string block_name(const std::size_t panel) { return "panel" + std::to_string(panel) + "curve"; }

    /// Two columns, the key of the first panel to their right.
    void write_panels(const Picture &picture, std::ostream &out)
    {
      out << "set multiplot layout " << (picture.panels.size() + 1) / 2 << "," << (picture.panels.size() > 1 ? 2 : 1) << " title "
          << quoted(picture.title)
          << " margins 0.07,0.7,0.1,0.88 spacing 0.08,0.2\nset key at screen 0.71,0.89 left top Left reverse samplen 2\n";
      for (std::size_t i = 0; i < picture.panels.size(); ++i)
        if (has_points(picture.panels[i]))
          {
            write_frame(picture.panels[i], out);
            write_few_ticks(picture.panels[i], out);
            write_plot(picture.panels[i], block_name(i), out);
            out << "unset key\n";
          }
      out << "unset multiplot\n";
    }
  } // namespace

  bool has_points(const Picture &picture)
  {
    for (const Curve &curve : picture.curves)
      for (const auto &point : curve.points)
        if (drawable(picture, point))
          return true;
    return std::any_of(picture.panels.begin(), picture.panels.end(), has_points);
  }

  std::string gnuplot_script(const Picture &picture)
  {
    std::ostringstream out;
    const std::string  block = "curve";
    write_data(picture, block, out);
    for (std::size_t i = 0; i < picture.panels.size(); ++i)
      write_data(picture.panels[i], block_name(i), out);
    for (const auto &[terminal, extension] :
         {std::pair<const char *, const char *>{"pngcairo noenhanced size 1500,900 font 'Sans,18' linewidth 2", ".png"},
          {"svg noenhanced size 1000,600 font 'Sans,14' linewidth 1.5 background 'white'", ".svg"}})
      {
        out << "set terminal " << terminal << "\nset output " << quoted(picture.name + extension) << "\n";
        if (picture.panels.empty())
          {
            out << "set key outside right top spacing " << (picture.lines ? "1" : "1.5") << "\n";
            write_frame(picture, out);
            write_plot(picture, block, out);
          }
        else
          write_panels(picture, out);
      }
    return out.str();
  }

  std::size_t draw(const std::vector<Picture> &pictures, const std::filesystem::path &folder)
  {
    std::string script;
    std::size_t n   = 0;
    const auto  all = folder / "pictures.gp", console = folder / "gnuplot.log";
    on_writing_rank("output folder " + folder.string(), "a folder that can be made and written", "choose another one with --out", [&] {
      std::filesystem::create_directories(folder);
      for (const Picture &picture : pictures)
        if (has_points(picture))
          {
            const std::string own = gnuplot_script(picture);
            replace_file(folder / (picture.name + ".gp"), own);
            script += own + "reset\n";
            ++n;
          }
      replace_file(all, script);
    });
    // All at once: starting the program takes longer than drawing.
    Processes processes;
    processes.start({"/usr/bin/env", "--chdir=" + folder.string(), "gnuplot", all.filename().string()}, console); // no name is a command
    std::vector<Ended> ended;
    while (ended.empty())
      ended = processes.wait(1);
    std::ostringstream words;
    words << std::ifstream(console).rdbuf();
    std::filesystem::remove(all);
    std::filesystem::remove(console);
    if (ended.front().exit_code == 127)
      throw InputError(InputProblem{"gnuplot", "is not there", "the program that draws the pictures", "./myolines.sh install"});
    if (ended.front().exit_code != 0)
      throw SystemError("gnuplot failed: " + words.str());
    return n;
  }
} // namespace myolines::study
