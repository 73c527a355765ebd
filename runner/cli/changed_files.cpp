#include "cli/changed_files.hpp"

#include "base/file.hpp"
#include "base/mapped_text.hpp"
#include "base/tokens.hpp"
#include "lab/scene_numbers.hpp"
#include "shader/definitions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace tidemark::cli {

using namespace host;
namespace {

/// The changes for one file.
struct Changes {
    std::vector<scene::Knob> knobs;
    std::vector<scene::Setting> definitions;
    std::vector<glsl::Cure> numbers; ///< constants without a name
};

Result<std::map<std::string, Changes>> changes_by_file(scene::Scene scene,
                                                       const std::vector<scene::Setting>& settings) {
    std::map<std::string, Changes> files;
    const auto definitions = glsl::definitions_of(scene);
    for (const scene::Setting& setting : settings) {
        const auto knob = std::ranges::find(scene.knobs, setting.name, &scene::Knob::name);
        if (knob != scene.knobs.end()) {
            TRY(scene::override_knob(scene, setting.name + "=" + setting.value));
            files[knob->where.file].knobs.push_back(*knob);
            continue;
        }
        const auto defined = std::ranges::find(definitions, setting.name, &glsl::NamedText::name);
        if (defined != definitions.end())
            files[defined->file].definitions.push_back(setting);
        else if (const auto number = lab::number_at(scene, setting.name))
            files[number->where.file].numbers.push_back(lab::replaced(*number, setting.value));
    }
    return files;
}

/// Returns the fixes reduced to the replacements in `file`; fixes without any are kept, empty.
std::vector<glsl::Cure> in_file(std::span<const glsl::Cure> cures, const std::string& file) {
    std::vector<glsl::Cure> those(cures.begin(), cures.end());
    for (glsl::Cure& cure : those)
        std::erase_if(cure.wraps, [&](const glsl::Wrap& wrap) { return wrap.first.where.file != file; });
    return those;
}

/// Saves the changes that were not made as a .diff file next to the first of `files`. Returns the error, with
/// the name of that file added.
tl::unexpected<Error> with_difference(Error error, std::span<const ChangedFile> files) {
    std::string text;
    for (const ChangedFile& file : files)
        text += difference(file);
    constexpr int k_attempts = 100;
    for (int i = 1; i <= k_attempts; ++i) {
        const std::string name =
            fmt::format("{}{}.diff", files.front().file, i == 1 ? "" : fmt::format(".{}", i));
        std::error_code ignored;
        if (std::filesystem::exists(std::filesystem::symlink_status(name, ignored)))
            continue; // belongs to the user
        if (write_file(OutputPath(name), std::as_bytes(std::span(text))))
            error.message += fmt::format("; the change is saved in '{}'", name);
        break;
    }
    return fail(std::move(error));
}

} // namespace

Result<std::vector<ChangedFile>> with_settings(const scene::Scene& scene,
                                               const std::vector<scene::Setting>& settings) {
    std::vector<ChangedFile> changed;
    for (const auto& [file, changes] : TRY(changes_by_file(scene, settings))) {
        const std::string text = TRY(read_text_file(file));
        const auto with_numbers = glsl::cured(text, file, changes.numbers);
        if (!with_numbers)
            return fail(
                ErrorCode::write,
                fmt::format("'{}' changed on disk since it was analysed; run the command again", file));
        std::string after = TRY(scene::with_defaults(*with_numbers, changes.knobs));
        for (const scene::Setting& setting : changes.definitions)
            glsl::override_definition(after, setting);
        if (after != text)
            changed.push_back({file, text, std::move(after)});
    }
    return changed;
}

Result<std::string> CuredFiles::text_of(const std::string& file) {
    if (texts_.contains(file))
        return texts_[file];
    std::error_code ignored;
    const auto held = unsaved_.find(std::filesystem::weakly_canonical(file, ignored));
    texts_[file] = held != unsaved_.end() ? held->second : TRY(read_text_file(file));
    return texts_[file];
}

Result<std::vector<ChangedFile>> CuredFiles::with_last(std::span<const glsl::Cure> cures) {
    std::set<std::string> files;
    for (const glsl::Wrap& wrap : cures.back().wraps)
        files.insert(wrap.first.where.file);
    std::vector<ChangedFile> changed;
    for (const std::string& file : files) {
        const std::string text = TRY(text_of(file));
        const std::vector<glsl::Cure> here = in_file(cures, file);
        const auto before = glsl::cured(text, file, std::span(here).first(here.size() - 1));
        auto after = glsl::cured(text, file, here);
        if (!before || !after || *before == *after)
            return fail(
                ErrorCode::write,
                fmt::format("'{}' changed on disk since it was analysed; run the command again", file));
        changed.push_back({file, *before, *std::move(after)});
    }
    return changed;
}

std::string difference(const ChangedFile& file) {
    std::string text = fmt::format("--- {}\n+++ {}\n", file.file, file.file);
    const std::string texts[] = {text::with_plain_line_ends(file.before),
                                 text::with_plain_line_ends(file.after)};
    const auto before = text::lines_of(texts[0]), after = text::lines_of(texts[1]);
    for (size_t i = 0; i < std::min(before.size(), after.size()); ++i)
        if (before[i] != after[i])
            text += fmt::format("@@ -{0} +{0} @@\n-{1}\n+{2}\n", i + 1, before[i], after[i]);
    return text;
}

Result<void> write_files(const std::vector<ChangedFile>& files) {
    for (const ChangedFile& file : files) {
        const auto now = read_text_file(file.file);
        if (!now || *now != file.before)
            return with_difference(
                {ErrorCode::write,
                 fmt::format("'{}' changed on disk meanwhile; nothing was written", file.file),
                 {}},
                files);
    }
    for (size_t i = 0; i < files.size(); ++i)
        if (auto written = replace_text(OutputPath::typed(files[i].file), files[i].before, files[i].after);
            !written)
            return with_difference(std::move(written.error()), std::span(files).subspan(i));
    return {};
}

} // namespace tidemark::cli
