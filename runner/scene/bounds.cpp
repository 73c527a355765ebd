#include "scene/bounds.hpp"

#include "base/file.hpp"
#include "base/installed.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::scene {
namespace fs = std::filesystem;
namespace {

bool is_inside(const fs::path& file, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

/// Returns an empty path if the folder does not exist.
fs::path real_path(const fs::path& path) {
    std::error_code error;
    fs::path real = fs::canonical(path, error);
    return error ? fs::path() : real;
}

} // namespace

Bounds::Bounds(const fs::path& folder, bool allow_outside, const UnsavedTexts* unsaved)
    : folder_(folder.empty() ? "." : folder.string()), everything_(allow_outside), unsaved_(unsaved),
      library_(library_folder()) {
    if (const fs::path library = real_path(library_); !library.empty())
        roots_.push_back(library);
    const fs::path root = real_path(folder.empty() ? fs::path(".") : folder);
    if (root.empty())
        return;
    roots_.push_back(root);
    for (const char* name : {"textures", "lib"}) {
        // A link of that name could lead anywhere, so only a real folder at that place counts.
        const fs::path beside = root.parent_path() / name;
        if (real_path(beside) == beside)
            roots_.push_back(beside);
    }
}

Result<void> Bounds::check(const fs::path& file) const {
    const auto cannot_read = [&](std::string_view why) {
        return fail(ErrorCode::load, fmt::format("cannot read '{}': {}", file.string(), why));
    };
    if (is_inside(file, library_))
        if (const std::string why = why_no_library(); !why.empty())
            return cannot_read(why);
    if (everything_)
        return {};
    if (file.native().find('\0') != std::string::npos) // the system would read the name only up to there
        return cannot_read(why_unreadable(file));
    std::error_code error;
    fs::path real = fs::absolute(file, error);
    if (!error)
        real = fs::weakly_canonical(real, error);
    if (error)
        return cannot_read(error.message());
    if (std::any_of(roots_.begin(), roots_.end(),
                    [&](const fs::path& root) { return is_inside(real, root); }))
        return {};
    return fail(
        ErrorCode::load,
        fmt::format("'{}' lies outside the scene's folder '{}': move it there, into a folder 'textures' "
                    "or 'lib' beside it, or give --allow-outside",
                    file.string(), folder_));
}

Result<std::string> Bounds::read_text(const fs::path& file) const {
    return check(file).and_then([&] { return read_text_file(file); });
}

const std::string* Bounds::unsaved(const fs::path& file) const {
    if (!unsaved_ || unsaved_->empty())
        return nullptr;
    std::error_code ignored;
    const auto held = unsaved_->find(fs::weakly_canonical(file, ignored));
    return held == unsaved_->end() ? nullptr : &held->second;
}

} // namespace tidemark::scene
