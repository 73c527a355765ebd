#include "cli/check/check_fix.hpp"

#include "base/file.hpp"
#include "base/output_path.hpp"
#include "base/try.hpp"
#include "cli/changed_files.hpp"
#include "cli/check/check_probes.hpp"
#include "cli/check/fix_page.hpp"
#include "cli/check/fix_text.hpp"
#include "cli/console.hpp"
#include "cli/error_json.hpp"
#include "cli/forked.hpp"
#include "cli/json_dump.hpp"
#include "cli/options.hpp"
#include "cli/version.hpp"
#include "gl/reset.hpp"
#include "platform/headless_context.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tidemark::cli {
namespace {

/// Encodes each byte as the character of its code: JSON strings must be UTF-8, and files may hold any bytes.
std::string characters_of(std::string_view bytes) {
    std::string text;
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80)
            text += c;
        else
            text += {char(0xC0 | byte >> 6), char(0x80 | (byte & 0x3F))};
    }
    return text;
}

std::string bytes_of(std::string_view characters) {
    std::string bytes;
    for (size_t i = 0; i < characters.size(); ++i) {
        const auto first = static_cast<unsigned char>(characters[i]);
        bytes += first < 0x80 || i + 1 == characters.size()
                     ? characters[i]
                     : char((first & 0x03) << 6 | (static_cast<unsigned char>(characters[++i]) & 0x3F));
    }
    return bytes;
}

Json files_json(const std::vector<ChangedFile>& files) {
    Json json = Json::array();
    for (const ChangedFile& file : files)
        json.push_back({{"file", characters_of(file.file)},
                        {"before", characters_of(file.before)},
                        {"after", characters_of(file.after)}});
    return json;
}

std::vector<ChangedFile> files_of(const Json& json) {
    std::vector<ChangedFile> files;
    for (const Json& file : json)
        files.push_back({bytes_of(file.at("file").get<std::string>()),
                         bytes_of(file.at("before").get<std::string>()),
                         bytes_of(file.at("after").get<std::string>())});
    return files;
}

/// Runs in a child process, since a driver may hang or crash: sends one line for each fix and for each
/// remaining finding.
Result<void> mend(const FixOptions& options, const scene::Scene& scene, const lab::Promises& promises,
                  const Tell& tell) {
    const auto context = TRY(platform::HeadlessContext::create(options.device));
    lab::Mending mending;
    mending.hashes = options.hashes;
    CuredFiles cured;
    std::vector<ChangedFile> files; // changed by the last fix that can be written
    mending.can_be_written = [&](std::span<const glsl::Cure> cures) {
        auto changed = cured.with_last(cures);
        if (!changed)
            return false;
        files = *std::move(changed);
        return true;
    };
    Result<void> driver; // a fix is offered only if the driver drew it without an error
    mending.offered = [&](const lab::Offer& offer, std::span<const glsl::Cure> cures) {
        if (driver)
            driver = gl::check_work("drawing cures");
        if (!driver)
            return;
        tell(dump(Json{{"offer", to_json(offer, cures.back())},
                       {"text", to_text(offer, cures.back())},
                       {"files", files_json(files)}}));
    };
    mending.remains = [&](const lab::Remaining& remaining) {
        tell(dump(Json{{"remains", {{"finding", remaining.finding}, {"why", remaining.why}}}}));
    };
    TRY(lab::mend(scene, promises, mending));
    return driver ? gl::check_work("drawing cures") : driver;
}

/// Shows the child's lines as they arrive.
class Report {
public:
    Report(const FixOptions& options, std::optional<OutputPath> folder)
        : options_(options), folder_(std::move(folder)) {}

    Result<void> hear(const Json& line) {
        if (auto error = error_of(line))
            return fail(*std::move(error));
        return line.contains("offer") ? take_offer(line) : take_remaining(line.at("remains"));
    }

    Result<int> finish(const scene::Scene& scene, const std::string& cut) {
        if (!cut.empty())
            say(cut);
        if (folder_)
            TRY(write_page(scene, cut));
        if (options_.json)
            TRY(put(dump(Json{{"tidemark", k_version},
                              {"scene", scene.file.string()},
                              {"cures", offers_},
                              {"remain", remaining_},
                              {"cut", cut}},
                         2) +
                    "\n"));
        else if (offers_.empty() && remaining_.empty() && cut.empty())
            TRY(put("nothing to mend\n"));
        return !cut.empty()         ? exit_code(ErrorCode::timed_out)
               : remaining_.empty() ? 0
                                    : exit_code(ErrorCode::check_failed);
    }

private:
    Result<void> take_offer(const Json& line) {
        const std::vector<ChangedFile> files = files_of(line.at("files"));
        if (options_.write)
            TRY(write_files(files));
        std::string difference_text;
        for (const ChangedFile& file : files)
            difference_text += difference(file);
        Json offer = line.at("offer");
        offer["difference"] = difference_text;
        offer["written"] = options_.write;
        cards_.push_back(
            {offer.at("finding").get<std::string>(), line.at("text").get<std::string>(), difference_text});
        offers_.push_back(std::move(offer));
        return options_.json ? Result<void>()
                             : put(line.at("text").get<std::string>() + difference_text + "\n");
    }

    Result<void> take_remaining(const Json& remaining) {
        remaining_.push_back(remaining);
        remaining_cards_.push_back(
            {remaining.at("finding").get<std::string>(), remaining.at("why").get<std::string>()});
        return options_.json
                   ? Result<void>()
                   : put(fmt::format("{}\n  not mended: {}\n", remaining.at("finding").get<std::string>(),
                                     remaining.at("why").get<std::string>()));
    }

    Result<void> write_page(const scene::Scene& scene, const std::string& cut) const {
        const OutputPath page = *folder_ / "index.html";
        TRY(write_file(page, fix_page(scene.file.string(), cards_, remaining_cards_, cut)));
        say(fmt::format("wrote {}", page.path().string()));
        return {};
    }

    const FixOptions& options_;
    std::optional<OutputPath> folder_; ///< of the page
    std::vector<CureCard> cards_{};
    std::vector<RemainingCard> remaining_cards_{};
    Json offers_ = Json::array(), remaining_ = Json::array();
};

/// Returns why the run did not complete; empty if it did.
std::string why_cut(const ForkedResult& run, double budget) {
    return run.timed_out ? fmt::format("--budget of {:.3g} s is spent: there may be more", budget)
                         : run.crash;
}

} // namespace

Result<int> check_fix(FixOptions options) {
    if (!(options.budget > 0))
        return fail(ErrorCode::usage, "--budget: give a number of seconds above 0");
    const scene::Scene scene = TRY(load_editable(options.scene));
    const lab::Promises promises = TRY(promises_of(options.scene, scene));
    std::optional<OutputPath> folder;
    if (!options.output.empty()) {
        folder = OutputPath::typed(options.output).sparing(files_read(scene));
        TRY(make_folder(*folder));
    }
    Report report(options, std::move(folder));
    Result<void> heard;
    const auto run = TRY(run_forked(
        [&](const Tell& tell) {
            if (auto done = mend(options, scene, promises, tell); !done)
                tell(dump(to_json(done.error())));
        },
        {.seconds = options.budget, .unwanted = [&] { return !heard; }},
        [&](std::string_view line) {
            if (heard)
                heard = report.hear(parse_json(line));
        }));
    if (!heard)
        return fail(heard.error());
    return report.finish(scene, why_cut(run, options.budget));
}

} // namespace tidemark::cli
