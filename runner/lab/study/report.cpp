#include "lab/study/report.hpp"

#include "base/base64.hpp"
#include "base/file.hpp"
#include "base/scratch_folder.hpp"
#include "image/compare/difference.hpp"
#include "image/compare/flip.hpp"
#include "image/files/child_process.hpp"
#include "image/files/picture_file.hpp"
#include "lab/study/diagram.hpp"
#include "lab/study/report_data.hpp"
#include "lab/study/report_html.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lab {
namespace fs = std::filesystem;
namespace {

class Report {
public:
    Report(const OutputPath& folder, Findings& findings)
        : folder_(folder), set_(findings.set), evidence_(findings.evidence) {}

    Result<void> write() {
        for (const auto part : {&Report::write_diagrams, &Report::write_maps})
            if (auto done = (this->*part)(); !done)
                return done;
        // Last, for they hold the remarks of all others.
        const std::pair<const char*, std::string> texts[] = {{"points.csv", to_csv(set_)},
                                                             {"study.json", to_json(set_)},
                                                             {"report.html", to_html(set_, media_)}};
        for (const auto& [name, text] : texts)
            if (auto done = write_file(folder_ / name, text); !done)
                return done;
        return {};
    }

private:
    void remark(std::string text) {
        auto& remarks = set_.circumstances.remarks;
        if (std::ranges::find(remarks, text) == remarks.end())
            remarks.push_back(std::move(text));
    }

    Result<void> write_diagrams() {
        if (auto done = write_diagram(Across::time, "error-vs-time"); !done)
            return done;
        if (!set_.has_hits())
            return {};
        return write_diagram(Across::work, "error-vs-work");
    }

    /// The script is written in any case: who has gnuplot elsewhere can run it there.
    Result<void> write_diagram(Across across, const std::string& name) {
        const std::string script = diagram_script(set_, across, name);
        if (script.empty()) {
            remark(fmt::format("{} has no point: every error is 0, or nothing was timed", name));
            return {};
        }
        const OutputPath file = folder_ / (name + ".gp");
        if (auto done = write_file(file, script); !done)
            return done;
        // It would write through any link that lies in the report's folder.
        const ScratchFolder scratch;
        std::string folder = scratch.path().string();
        for (size_t at = 0; (at = folder.find('\'', at)) != folder.npos; at += 2)
            folder.insert(at, 1, '\'');
        const auto drawn = image::output_of(
            {"gnuplot", "-e", fmt::format("cd '{}'", folder), fs::absolute(file.path()).string()},
            size_t{1} << 16);
        if (!drawn) {
            remark(fmt::format("no diagrams: {} (the data are in points.csv, the script is {}.gp)",
                               drawn.error().message, name));
            return {};
        }
        for (const char* ending : {".svg", ".png"})
            if (const auto picture = read_file(scratch.path() / (name + ending)))
                if (auto done = write_file(folder_ / (name + ending), *picture); !done)
                    return done;
        if (const auto svg = read_file(scratch.path() / (name + ".svg")))
            media_.diagrams.push_back({name, "data:image/svg+xml;base64," + base64(*svg)});
        return {};
    }

    /// The view on which the scene as it is does worst: there the differences are to be seen.
    size_t shown_view() const {
        const auto& views = set_.points.front().views;
        const auto worst = std::ranges::max_element(
            views, {}, [&](const Outcome& outcome) { return outcome.picture.samples.rmse; });
        return worst == views.end() ? 0 : size_t(worst - views.begin());
    }

    /// Writes a picture and returns it for the page.
    Result<std::string> keep(const std::string& name, const image::Image& picture) {
        const OutputPath file = folder_ / "maps" / (name + ".png");
        if (auto done = image::write_picture(file, picture); !done)
            return fail(std::move(done.error()));
        const auto bytes = read_file(file.path(), size_t{1} << 30);
        if (!bytes)
            return fail(bytes.error());
        return "data:image/png;base64," + base64(*bytes);
    }

    Result<void> show(const std::string& label, const std::string& name, const image::Image& picture) {
        auto source = keep(name, picture);
        if (!source)
            return fail(std::move(source.error()));
        media_.pictures.push_back({label, *std::move(source)});
        return {};
    }

    Result<void> write_maps() {
        if (evidence_.reference.empty())
            return {};
        if (auto made = make_folder(folder_ / "maps"); !made)
            return made;
        const size_t view = shown_view();
        media_.pictures_view = set_.study.views[view].name;
        const image::Image& reference = evidence_.reference[view];
        if (auto done = show("reference", "reference", reference); !done)
            return done;
        std::vector<EmbeddedPicture> maps;
        for (size_t i = 0; i < set_.points.size(); ++i) {
            if (!set_.points[i].measured())
                continue;
            const std::string& label = set_.points[i].point.label;
            const image::Image& picture = evidence_.pictures[i][view];
            if (auto done = show(label, fmt::format("{:02}-picture", i), picture); !done)
                return done;
            auto flip =
                keep(fmt::format("{:02}-flip", i), image::heat_map(image::flip(reference, picture).map));
            if (!flip)
                return fail(std::move(flip.error()));
            maps.push_back({"FLIP: " + label, *std::move(flip)});
            if (evidence_.causes[i].empty())
                continue;
            auto causes = keep(fmt::format("{:02}-causes", i), evidence_.causes[i][view]);
            if (!causes)
                return fail(std::move(causes.error()));
            maps.push_back({"causes: " + label, *std::move(causes)});
        }
        std::ranges::move(maps, std::back_inserter(media_.pictures));
        return {};
    }

    const OutputPath& folder_;
    WorkPrecisionSet& set_;
    const Evidence& evidence_;
    PageMedia media_;
};

} // namespace

Result<void> write_report(const OutputPath& folder, Findings& findings) {
    return Report(folder, findings).write();
}

} // namespace tidemark::lab
