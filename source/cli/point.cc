#include <myolines/base/error.h>
#include <myolines/cli/catalogue.h>
#include <myolines/cli/point.h>
#include <myolines/muscle3d/parameters.h>
#include <myolines/output/csv_file.h>
#include <myolines/output/text_file.h>
#include <myolines/study/picture.h>

#include <algorithm>
#include <cmath>
#include <iomanip>

#include <unistd.h>

namespace myolines
{
  namespace
  {
    std::vector<double> spaced(const std::vector<double> &range, const std::string &option, const double least)
    {
      std::vector<InputProblem> problems;
      const auto   refuse = [&](const std::string &what, const std::string &expected) { problems.push_back({option, what, expected, ""}); };
      const double n      = range.at(2);
      for (const double end : {range[0], range[1]})
        if (!std::isfinite(end))
          refuse("FROM or TO = " + exact_text(end), "finite numbers");
      if (!(range[0] > least))
        refuse("FROM = " + exact_text(range[0]), "FROM > " + exact_text(least));
      if (!(range[0] < range[1]))
        refuse("FROM = " + exact_text(range[0]) + " is not below TO = " + exact_text(range[1]), "FROM < TO");
      if (!(n >= 2 && n <= 1e6) || n != std::floor(n))
        refuse("POINTS = " + exact_text(n), "POINTS, an integer in [2, 1000000]");
      if (!problems.empty())
        throw InputError(problems);
      std::vector<double> x;
      for (unsigned int i = 0; i < n; ++i)
        x.push_back(range[0] + (range[1] - range[0]) * i / (n - 1));
      return x;
    }

    /// The laws of one tissue.
    class TissueLaw
    {
    public:
      TissueLaw(const TissueParameters &tissue, const curves::FibreCurves &curves)
        : material_(material(tissue))
        , curves_(curves)
        , muscle_(tissue.fibre.law == FibreLaw::muscle)
        , rate_(tissue.fibre.force_velocity)
      {}

      bool muscle() const { return muscle_; }

      /// Stress along the fibre [Pa].
      double fibre(const double stretch, const double strain_rate, const double activation) const
      {
        Activation a;
        a.level[0] = activation;
        const FibreTerms terms{muscle_, muscle_ && activation > 0, rate_, !muscle_, &a, &curves_};
        return finite(stretch * fibre_stress(material_.data(), terms, stretch, strain_rate).g, stretch, strain_rate);
      }

      /// Uniaxial Cauchy stress of the isotropic parts [Pa].
      double base(const double s) const
      {
        return finite(2 * (s * s - 1 / s) * yeoh(material_.data() + material_yeoh, s * s + 2 / s).first, s, 0);
      }

    private:
      /// @throws InputError where the numbers end.
      static double finite(const double stress, const double stretch, const double strain_rate)
      {
        if (std::isfinite(stress) && std::isfinite(stretch) && std::isfinite(strain_rate))
          return stress;
        throw InputError(
            InputProblem{"--stretch, --strain-rate",
                         "the stress at stretch " + exact_text(stretch) + " and strain rate " + exact_text(strain_rate) + " is not finite",
                         "ranges in which stresses are finite", ""});
      }

      const Material             material_;
      const curves::FibreCurves &curves_;
      const bool                 muscle_, rate_;
    };

    std::string percent(const double activation)
    {
      std::ostringstream text;
      text << "activation " << 100 * activation << " %";
      return text.str();
    }

    /// A table and the picture of its columns over the first one.
    class Sheet
    {
    public:
      Sheet(const std::filesystem::path &folder, const std::string &name, const std::string &title, const std::string &abscissa,
            const std::vector<std::string> &columns)
        : csv_({folder}, name + ".csv", headers(abscissa, columns))
      {
        picture_.name    = name;
        picture_.title   = title;
        picture_.x_label = abscissa;
        picture_.y_label = "stress [Pa]";
        picture_.marks   = false;
        for (const std::string &column : columns)
          picture_.curves.push_back({column, {}});
      }

      void row(const double x, const std::vector<double> &stress)
      {
        std::vector<double> all{x};
        all.insert(all.end(), stress.begin(), stress.end());
        csv_.row(all);
        for (std::size_t i = 0; i < stress.size(); ++i)
          picture_.curves[i].points.emplace_back(x, stress[i]);
      }

      const study::Picture &picture() const { return picture_; }

    private:
      static std::vector<std::string> headers(const std::string &abscissa, const std::vector<std::string> &columns)
      {
        std::vector<std::string> all{abscissa};
        for (const std::string &column : columns)
          all.push_back(column + " [Pa]");
        return all;
      }

      CsvFile        csv_;
      study::Picture picture_;
    };

    /// All sheets of one tissue.
    class TissueSheets
    {
    public:
      TissueSheets(std::string name, TissueLaw law, const PointOptions &options)
        : name_(std::move(name))
        , law_(std::move(law))
        , folder_(options.folder)
        , stretches_(spaced(options.stretch, "--stretch", 0))
        , rates_(spaced(options.strain_rate, "--strain-rate", -1e9))
        , activations_(law_.muscle() ? options.activation : std::vector<double>{0})
      {}

      std::vector<study::Picture> write() const
      {
        std::vector<study::Picture> pictures{stretch_sheet(), base_sheet()};
        if (law_.muscle())
          {
            pictures.push_back(rate_sheet());
            pictures.push_back(surface());
          }
        return pictures;
      }

    private:
      std::vector<std::string> labels() const
      {
        if (!law_.muscle())
          return {"fibre"};
        std::vector<std::string> texts;
        for (const double a : activations_)
          texts.push_back(percent(a));
        return texts;
      }

      std::vector<double> at_all_activations(const double stretch, const double rate) const
      {
        std::vector<double> stress;
        for (const double a : activations_)
          stress.push_back(law_.fibre(stretch, rate, a));
        return stress;
      }

      study::Picture stretch_sheet() const
      {
        Sheet sheet(folder_, name_ + "_stretch", "Fibre stress of " + name_ + " at rest", "stretch [-]", labels());
        for (const double s : stretches_)
          sheet.row(s, at_all_activations(s, 0));
        return sheet.picture();
      }

      study::Picture rate_sheet() const
      {
        Sheet sheet(folder_, name_ + "_strain_rate", "Fibre stress of " + name_ + " at stretch 1", "strain rate [-]", labels());
        for (const double e : rates_)
          sheet.row(e, at_all_activations(1, e));
        return sheet.picture();
      }

      study::Picture base_sheet() const
      {
        Sheet sheet(folder_, name_ + "_base", "Base material of " + name_ + ", uniaxial", "stretch [-]", {"base material"});
        for (const double s : stretches_)
          sheet.row(s, {law_.base(s)});
        return sheet.picture();
      }

      /// All stretches by all rates; the picture has a few rates.
      study::Picture surface() const
      {
        const std::size_t        shown = std::min<std::size_t>(6, rates_.size());
        std::vector<std::string> titles;
        std::vector<double>      rates;
        for (std::size_t i = 0; i < shown; ++i)
          {
            std::ostringstream text;
            rates.push_back(rates_[i * (rates_.size() - 1) / (shown - 1)]);
            text << std::setprecision(3) << "strain rate " << rates.back();
            titles.push_back(text.str());
          }
        CsvFile csv({folder_}, name_ + "_surface.csv", {"stretch [-]", "strain rate [-]", "fibre, fully active [Pa]"});
        for (const double s : stretches_)
          for (const double e : rates_)
            csv.row(std::vector<double>{s, e, law_.fibre(s, e, 1)});
        study::Picture picture;
        picture.name    = name_ + "_surface";
        picture.title   = "Fibre stress of " + name_ + ", fully active";
        picture.x_label = "stretch [-]";
        picture.y_label = "stress [Pa]";
        picture.marks   = false;
        for (std::size_t i = 0; i < shown; ++i)
          {
            picture.curves.push_back({titles[i], {}});
            for (const double s : stretches_)
              picture.curves.back().points.emplace_back(s, law_.fibre(s, rates[i], 1));
          }
        return picture;
      }

      std::string           name_;
      TissueLaw             law_;
      std::filesystem::path folder_;
      std::vector<double>   stretches_, rates_, activations_;
    };

    void print(const std::string &name, const TissueLaw &law, std::ostream &out)
    {
      const double a = law.muscle() ? 1 : 0;
      out << name << (law.muscle() ? ", fully active at rest" : "") << "\n  stretch [-]   fibre [kPa]   base material [kPa]\n";
      for (int i = -4; i <= 6; ++i)
        {
          const double s = 1 + 0.1 * i;
          out << std::fixed << std::setprecision(1) << std::setw(9) << s << std::setprecision(3) << std::setw(17)
              << 1e-3 * law.fibre(s, 0, a) << std::setw(18) << 1e-3 * law.base(s) << "\n";
        }
    }
  } // namespace

  void point_command(const std::filesystem::path &scene, const std::vector<std::string> &overrides, PointOptions options, std::ostream &out)
  {
    if (options.folder.empty())
      options.folder = std::filesystem::path("results") / (scene.stem().string() + " point");
    for (const double a : options.activation)
      if (!(a >= 0 && a <= 1))
        throw InputError(InputProblem{"--activation", std::to_string(a), "numbers in [0, 1]", ""});
    const scene::Node  whole  = read_whole_scene(scene, overrides);
    const scene::Node &system = whole.section("system");
    if (system.text("type") != "muscle 3d")
      system.refuse("type", "\"" + system.text("type") + "\" has no tissues", "\"muscle 3d\"");
    const Muscle3dParameters  parameters = read_muscle3d(system);
    const curves::FibreCurves curves     = parameters.fibre_curves();
    on_writing_rank("output folder " + options.folder.string(), "a folder that can be made and written", "choose another one with --out",
                    [&] {
                      std::filesystem::create_directories(options.folder / "pictures");
                      if (access(options.folder.c_str(), W_OK) != 0)
                        throw std::runtime_error("it cannot be written");
                    });
    std::vector<study::Picture> pictures;
    for (const TissueKind &kind : tissue_kinds())
      if (const auto tissue = parameters.tissues.find(kind.id); tissue != parameters.tissues.end())
        {
          const TissueLaw law(tissue->second, curves);
          for (study::Picture &picture : TissueSheets(kind.name, law, options).write())
            pictures.push_back(std::move(picture));
          print(kind.name, law, out);
        }
    const std::size_t drawn = study::draw(pictures, options.folder / "pictures");
    out << "Tables and " << drawn << " pictures are in " << options.folder.string() << std::endl;
  }
} // namespace myolines
