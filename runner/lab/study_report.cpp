#include "lab/study_report.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/folders.hpp"
#include "lab/study_data.hpp"
#include "lab/study_page.hpp"
#include "media/comparison.hpp"
#include "media/picture_file.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lab {

namespace fs = std::filesystem;
namespace {

/// Limit for all pictures embedded in the page, in bytes; the others are links to their files.
constexpr size_t k_most_embedded = size_t{16} << 20;

class Report {
public:
    Report(const OutputPath& folder, const Findings& findings)
        : folder_(folder), set_(findings.set), evidence_(findings.evidence) {}

    /// Creates all contents before it writes the first file, so a report that fails leaves an older one
    /// intact.
    Result<void> write() {
        TRY(make_maps());
        add("points.csv", to_csv(set_));
        add("report.html", to_html(set_, media_));
        add("study.json", to_json(set_));
        return put_files();
    }

private:
    void add(fs::path name, std::string bytes) { files_.emplace_back(std::move(name), std::move(bytes)); }

    Result<void> put_files() const {
        std::vector<StagedFile> staged;
        for (const auto& [name, bytes] : files_) {
            if (auto made = make_folder(name.has_parent_path() ? folder_ / name.parent_path() : folder_);
                !made)
                return made;
            auto file = TRY(StagedFile::create(folder_ / name));
            TRY(file.write(std::as_bytes(std::span(bytes))));
            staged.push_back(std::move(file));
        }
        for (StagedFile& file : staged)
            TRY(file.commit());
        return {};
    }

    /// Returns the view with the largest error of the unchanged scene, in which differences are most visible.
    size_t shown_view() const {
        const auto& views = set_.points.front().views;
        const auto worst = std::ranges::max_element(
            views, {}, [&](const Outcome& outcome) { return outcome.picture.samples.rmse; });
        return worst == views.end() ? 0 : size_t(worst - views.begin());
    }

    /// Keeps a picture as `maps/NAME.png`, and embeds it in the page within the limit.
    Result<PagePicture> keep(const std::string& label, const std::string& name, const image::Image& picture) {
        const fs::path file = scratch_.path() / (name + ".png");
        TRY(image::write_picture(file, picture));
        auto bytes = TRY(read_file(file, size_t{1} << 30));
        PagePicture kept{label, "maps/" + name + ".png", {}};
        if (embedded_ + bytes.size() <= k_most_embedded) {
            embedded_ += bytes.size();
            kept.source = "data:image/png;base64," + base64(bytes);
        }
        add(kept.file, std::move(bytes));
        return kept;
    }

    /// Returns a point's picture, its difference from the reference, and the causes of wrong hits.
    Result<std::vector<PagePicture>> maps_of(size_t point, size_t view) {
        std::vector<PagePicture> maps;
        if (!set_.points[point].measured())
            return maps;
        const image::Image& picture = evidence_.pictures[point][view];
        const auto flip = image::heat_map(image::flip(evidence_.reference[view], picture).map);
        maps.push_back(TRY(keep("picture", fmt::format("{:02}-picture", point), picture)));
        maps.push_back(TRY(keep("FLIP", fmt::format("{:02}-flip", point), flip)));
        if (const auto& causes = evidence_.causes[point]; !causes.empty())
            maps.push_back(TRY(keep("causes", fmt::format("{:02}-causes", point), causes[view])));
        return maps;
    }

    Result<void> make_maps() {
        if (evidence_.reference.empty())
            return {};
        const size_t view = shown_view();
        media_.view = set_.study.views[view].name;
        media_.reference = TRY(keep("reference", "reference", evidence_.reference[view]));
        for (size_t i = 0; i < set_.points.size(); ++i)
            media_.points.push_back(TRY(maps_of(i, view)));
        return {};
    }

    const OutputPath& folder_;
    const WorkPrecisionSet& set_;
    const Evidence& evidence_;
    PageMedia media_;
    ScratchFolder scratch_;
    size_t embedded_ = 0; ///< bytes of pictures in the page
    using File = std::pair<fs::path, std::string>;
    std::vector<File> files_; ///< names in the folder, and contents
};

} // namespace

Result<void> write_report(const OutputPath& folder, const Findings& findings) {
    return Report(folder, findings).write();
}

} // namespace tidemark::lab
