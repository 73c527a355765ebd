#include "base/output_path.hpp"

#include "base/try.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <system_error>

namespace tidemark {
namespace fs = std::filesystem;
namespace {

constexpr int k_most_links = 40; ///< Linux's own limit

/// Returns N of `/dev/fd/N` and `/proc/self/fd/N`: links that stand for a descriptor, not for a path.
std::optional<int> descriptor_named(const fs::path& path) {
    std::error_code error;
    const fs::path parent = path.parent_path();
    const fs::path folder = fs::canonical(parent.empty() ? "." : parent, error);
    if (error || folder != fs::canonical("/proc/self/fd", error))
        return std::nullopt;
    const std::string digits = path.filename().string();
    int number = 0;
    const auto [end, wrong] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return wrong == std::errc() && *end == '\0' ? std::optional(number) : std::nullopt;
}

/// Follows links to their final target, which need not exist: the target is replaced, not the link.
Result<fs::path> behind_links(fs::path path) {
    const fs::path asked = path;
    for (int i = 0; i < k_most_links; ++i) {
        std::error_code no_link;
        const fs::path target = fs::read_symlink(path, no_link);
        if (no_link || descriptor_named(path))
            return path;
        path = path.parent_path() / target;
    }
    return fail(ErrorCode::write, fmt::format("cannot write '{}': {}", asked.string(), system_reason(ELOOP)));
}

bool is_stream(const fs::path& path) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    return fs::is_other(status) && status.type() != fs::file_type::unknown;
}

} // namespace

OutputPath OutputPath::typed(fs::path path) {
    OutputPath output(std::move(path));
    output.chosen_parts_ = 0;
    return output;
}

OutputPath OutputPath::typed_or(const fs::path& typed, fs::path choice) {
    return typed.empty() ? OutputPath(std::move(choice)) : OutputPath::typed(typed);
}

OutputPath OutputPath::operator/(const fs::path& name) const {
    const fs::path below = name.relative_path(); // an absolute name would leave the folder
    OutputPath output = *this;
    output.whole_ /= below;
    output.chosen_parts_ += size_t(std::distance(below.begin(), below.end()));
    return output;
}

OutputPath OutputPath::beside(std::string_view ending) const {
    OutputPath output = *this;
    if (!whole_.has_filename()) // it ends in a slash
        output.whole_ = whole_.parent_path();
    output.whole_ += ending;
    output.chosen_parts_ = std::max<size_t>(chosen_parts_, 1);
    return output;
}

OutputPath OutputPath::sparing(const std::vector<fs::path>& files) const {
    OutputPath output = *this;
    output.spared_.insert(output.spared_.end(), files.begin(), files.end());
    return output;
}

Result<void> OutputPath::check_links() const {
    size_t named = size_t(std::distance(whole_.begin(), whole_.end())) - chosen_parts_;
    fs::path part;
    for (const fs::path& name : whole_) {
        part /= name;
        if (named > 0) {
            --named;
            continue;
        }
        if (name == "..")
            return fail(ErrorCode::write,
                        fmt::format("cannot write '{}': the name leads out of its folder", whole_.string()));
        std::error_code no_link;
        const fs::path target = fs::read_symlink(part, no_link);
        if (!no_link)
            return fail(
                ErrorCode::write,
                fmt::format("cannot write '{}': {} is a link to '{}', and a link is followed only where "
                            "-o names it: remove it, or give another place",
                            whole_.string(), part == whole_ ? "it" : fmt::format("'{}'", part.string()),
                            target.string()));
    }
    return {};
}

Result<void> OutputPath::check_spared(const fs::path& final_path) const {
    struct stat there {};
    if (spared_.empty() || ::stat(final_path.c_str(), &there) != 0)
        return {};
    for (const fs::path& file : spared_) {
        struct stat read {};
        if (::stat(file.c_str(), &read) == 0 && read.st_dev == there.st_dev && read.st_ino == there.st_ino)
            return fail(ErrorCode::write, fmt::format("cannot write '{}': this command reads that file; give "
                                                      "another name with -o",
                                                      whole_.string()));
    }
    return {};
}

Result<OutputPath::Place> OutputPath::place() const {
    TRY(check_links());
    Place place{whole_};
    if (chosen_parts_ == 0) {
        place.path = TRY(behind_links(whole_));
        place.descriptor = descriptor_named(place.path);
    }
    place.stream = place.descriptor || is_stream(place.path);
    if (!place.stream)
        TRY(check_spared(place.path));
    return place;
}

} // namespace tidemark
