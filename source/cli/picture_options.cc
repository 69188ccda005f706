// SPDX-License-Identifier: LGPL-2.1-or-later
#include "picture_options.h"

namespace myolines
{
  void add_plot_options(CLI::App &command, study::PlotOptions &options)
  {
    command.add_option("folders", options.folders, "Output folders")->required()->type_name("DIR");
    command.add_option("--out", options.out, "Where to write; default: pictures/ in the folder, or here if there are several")
        ->type_name("DIR");
    command.add_option("--file", options.file, "Of runs: only this table, such as reaction.csv")->type_name("FILE.csv");
  }

  void add_picture_options(CLI::App &command, picture::PictureOptions &options)
  {
    command.add_option("folders", options.folders, "Output folders of runs that wrote fields")->required()->type_name("DIR");
    command.add_option("--out", options.out, "Where to write; default: pictures/ in the folder, or here if there are several")
        ->type_name("DIR");
    command.add_option("--field", options.field, "What colours the body; default: stretch, if the run wrote it")->type_name("NAME");
    command.add_option("--at", options.at, "Times [s], side by side; default: the first and the last of one run, the last of several")
        ->type_name("TIME ...");
    command.add_flag("--frames", options.frames, "One picture of each time, and an animation of them");
    command.add_option("--fibres", options.fibres, "So many lines along the fibres, the surface a veil around them")->type_name("NUMBER");
    command.add_option("--cut", options.cut, "Takes away what lies beyond this part of the extent at rest along x, y or z: z:0.5")
        ->type_name("AXIS:PART");
    command.add_option("--view", options.view, "Azimuth and elevation of the viewer [degree]; default: 25 20")
        ->expected(2)
        ->type_name("AZIMUTH ELEVATION");
    command.add_option("--range", options.range, "Of the colours; default: of what is drawn")->expected(2)->type_name("FROM TO");
    command.add_option("--width", options.width, "Of the picture [px]")->capture_default_str()->type_name("PIXELS");
    command.add_option("--rate", options.rate, "Of the animation [1/s]")->capture_default_str()->type_name("NUMBER");
  }

  void add_report_options(CLI::App &command, report::ReportOptions &options)
  {
    command.add_option("folder", options.folder, "Output folder of a run or of a study")->required()->type_name("DIR");
    command.add_option("--out", options.out, "The file to write; default: report.html in the folder")->type_name("FILE.html");
  }
} // namespace myolines
