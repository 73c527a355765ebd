// The page of `tidemark check --fix -o`: each fix with its measurements and its difference. Returns text.

#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/changed_files.hpp"
#include "cli/check.hpp"
#include "cli/commands.hpp"
#include "host/console.hpp"
#include "host/forked.hpp"
#include "host/frame_files.hpp"
#include "host/gl_context.hpp"
#include "host/json.hpp"
#include "host/requests.hpp"
#include "lab/fix.hpp"
#include "lab/report_page.hpp"
#include "render/gl_context.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <span>
#include <string>
#include <utility>

namespace tidemark::cli {

using namespace host;
using host::number;
using host::to_json;

/// A fix as text (cli/check_fix.cpp), and its change of the files.
struct CureCard {
    std::string finding;
    std::string text; ///< the finding's sentence, then the measurements
    std::string difference;
};

/// A finding without a fix, and why.
struct RemainingCard {
    std::string finding;
    std::string why;
};

namespace {

using report::escaped;
using report::escaped_lines;

/// Returns the text after its first line, which is the finding and serves as the heading.
std::string measured(const CureCard& cure) {
    return cure.text.substr(std::min(cure.text.size(), cure.finding.size() + 1));
}

std::string article(const CureCard& cure) {
    return fmt::format("<article class=\"finding pass\">\n<div>\n<h3>{}</h3>\n<pre>{}</pre>\n<pre>{}</pre>\n"
                       "</div>\n</article>\n",
                       escaped(cure.finding), escaped_lines(measured(cure)), escaped_lines(cure.difference));
}

std::string section(const char* heading, const std::string& body) {
    return body.empty() ? "" : fmt::format("<h2>{}</h2>\n{}", heading, body);
}

} // namespace

/// `cut`: why there may be more findings; empty: the run was complete.
std::string fix_page(const std::string& scene, std::span<const CureCard> cures,
                     std::span<const RemainingCard> remaining, const std::string& cut) {
    std::string mended, left;
    for (const CureCard& cure : cures)
        mended += article(cure);
    for (const RemainingCard& each : remaining)
        left += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(each.finding), escaped(each.why));
    if (!left.empty())
        left = "<dl class=\"rows\">\n" + left + "</dl>\n";
    if (!cut.empty())
        left += fmt::format("<p>{}</p>\n", escaped(cut));
    const std::string name = name_after_scene(scene, "");
    return report::make_page(
        {name + ": fixes", name,
         fmt::format("{} fix{}, each measured on top of those before it; {} finding{} not fixed.",
                     cures.size(), cures.size() == 1 ? "" : "s", remaining.size(),
                     remaining.size() == 1 ? " is" : "s are"),
         section("Fixes", mended) + section("Not fixed", left)});
}

namespace {

Json number_or_null(const std::optional<double>& value) {
    return value ? Json(*value) : Json();
}

std::string both(const char* what, const std::optional<double>& before, const std::optional<double>& after,
                 const char* unit) {
    return before && after ? fmt::format("  {}: {:.3g} -> {:.3g}{}\n", what, *before, *after, unit) : "";
}

} // namespace

std::string to_text(const lab::Offer& offer, const glsl::Cure& cure) {
    const lab::Judgement& seen = offer.judgement;
    std::string text = fmt::format("{}\n  fix: {}\n  {}: {:.3g} -> {:.3g}\n", offer.finding, cure.reason,
                                   seen.fault.of, seen.fault.before, seen.fault.after);
    text += seen.changed == 0 ? fmt::format("  elsewhere: unchanged in all {} pixels\n", seen.compared)
                              : fmt::format("  elsewhere: changed in {} of {} pixels, FLIP at most {:.2g}\n",
                                            seen.changed, seen.compared, seen.flip);
    text += both("error against double (RMSE)", seen.error_before, seen.error_after, "");
    return text +
           both("CPU time per frame of 320x180", seen.milliseconds_before, seen.milliseconds_after, " ms");
}

Json to_json(const lab::Offer& offer, const glsl::Cure& cure) {
    const lab::Judgement& seen = offer.judgement;
    return {{"finding", offer.finding},
            {"cure", cure.reason},
            {"fault", {{"of", seen.fault.of}, {"before", seen.fault.before}, {"after", seen.fault.after}}},
            {"pixels_compared", seen.compared},
            {"pixels_changed", seen.changed},
            {"flip", seen.flip},
            {"error_before", number_or_null(seen.error_before)},
            {"error_after", number_or_null(seen.error_after)},
            {"ms_before", number_or_null(seen.milliseconds_before)},
            {"ms_after", number_or_null(seen.milliseconds_after)}};
}

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

std::string decoded_bytes(std::string_view characters) {
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

} // namespace

std::vector<ChangedFile> files_of_offer(const Json& line) {
    std::vector<ChangedFile> files;
    for (const Json& file : line.at("files"))
        files.push_back({decoded_bytes(file.at("file").get<std::string>()),
                         decoded_bytes(file.at("before").get<std::string>()),
                         decoded_bytes(file.at("after").get<std::string>())});
    return files;
}

Result<void> send_fixes(const FixOptions& options, const scene::Scene& scene, const lab::Promises& promises,
                        const Tell& tell, std::function<void(const Result<lab::ShownError>&)> measured) {
    lab::Mending mending;
    mending.hashes = options.hashes;
    mending.measured = std::move(measured);
    CuredFiles cured(options.scene.files.unsaved);
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
            driver = gl::check_work("drawing fixes");
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
    return driver ? gl::check_work("drawing fixes") : driver;
}

namespace {

/// Runs in the child process.
Result<void> mend(const FixOptions& options, const scene::Scene& scene, const lab::Promises& promises,
                  const Tell& tell) {
    const auto context = TRY(host::HeadlessContext::create(options.device));
    return send_fixes(options, scene, promises, tell);
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
            TRY(put("nothing to fix\n"));
        return !cut.empty()         ? exit_code(ErrorCode::timed_out)
               : remaining_.empty() ? 0
                                    : exit_code(ErrorCode::check_failed);
    }

private:
    Result<void> take_offer(const Json& line) {
        const std::vector<ChangedFile> files = files_of_offer(line);
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
                   : put(fmt::format("{}\n  not fixed: {}\n", remaining.at("finding").get<std::string>(),
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
    return run.timed_out ? fmt::format("--budget of {:.3g} s is used up: there may be more findings", budget)
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
