#include "base/file.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace tidemark {

int Descriptor::release() {
    return std::exchange(fd_, -1);
}

int Descriptor::close() {
    const int fd = release();
    return fd < 0 || ::close(fd) == 0 ? 0 : errno;
}

tl::expected<std::string, int> read_all(int fd, size_t largest) {
    struct stat facts {};
    if (::fstat(fd, &facts) != 0)
        return tl::unexpected<int>(errno);
    if (S_ISREG(facts.st_mode) && uintmax_t(facts.st_size) > largest)
        return tl::unexpected<int>(EFBIG);
    std::string bytes;
    bytes.reserve(size_t(facts.st_size));
    char block[1 << 13]; // a thread's stack may be small
    for (;;) {           // the file may grow meanwhile, and files of /proc have size 0
        const ssize_t count = ::read(fd, block, sizeof block);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return tl::unexpected<int>(errno);
        if (count == 0)
            return bytes;
        if (size_t(count) > largest - bytes.size())
            return tl::unexpected<int>(EFBIG);
        bytes.append(block, size_t(count));
    }
}

int write_all(int fd, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(fd, bytes.data(), bytes.size());
        if (written >= 0) {
            bytes = bytes.subspan(size_t(written));
        } else if (errno == EAGAIN) {
            pollfd wait{fd, POLLOUT, 0};
            ::poll(&wait, 1, -1);
        } else if (errno != EINTR) {
            return errno;
        }
    }
    return 0;
}

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
    return number_from<int>(path.filename().string());
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
            return fail(ErrorCode::write,
                        fmt::format("cannot write '{}': {} is a link to '{}', and only links named with -o "
                                    "are followed: remove the link, or give another name",
                                    whole_.string(),
                                    part == whole_ ? "it" : fmt::format("'{}'", part.string()),
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

namespace {

/// Returns the name of an existing file that differs from `path` in the case of its letters, or in
/// backslashes for slashes; empty if there is none.
std::string name_nearby(const fs::path& path) {
    std::string name = path.string();
    std::error_code ignored;
    if (name.find('\\') != std::string::npos) {
        std::ranges::replace(name, '\\', '/');
        return fs::exists(name, ignored) ? name : std::string();
    }
    constexpr int k_most = 10'000; // entries of a large folder are not all read for a hint
    const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
    const std::string wanted = lower_case(path.filename().string());
    int left = k_most;
    for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end && left-- > 0;
         entry.increment(ignored))
        if (lower_case(entry->path().filename().string()) == wanted)
            return entry->path().filename().string();
    return {};
}

/// Returns why nothing exists at `path`; names the dangling link if there is one on the way.
std::string why_missing(const fs::path& path) {
    fs::path way;
    for (const fs::path& part : path) {
        way /= part;
        std::error_code ignored;
        if (!fs::is_symlink(way, ignored) || fs::exists(way, ignored))
            continue;
        const std::string target = fs::read_symlink(way, ignored).string();
        return way == path
                   ? fmt::format("it is a link to '{}', which does not exist", target)
                   : fmt::format("'{}' is a link to '{}', which does not exist", way.string(), target);
    }
    const std::string near = name_nearby(path);
    return near.empty() ? "no such file" : fmt::format("no such file; did you mean '{}'?", near);
}

} // namespace

std::string why_unreadable(const fs::path& path) {
    if (path.native().find('\0') != std::string::npos)
        return "there is a zero byte in its name";
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    switch (status.type()) {
    case fs::file_type::regular: return {};
    case fs::file_type::not_found: return why_missing(path);
    case fs::file_type::directory: return "it is a directory";
    default: return error ? error.message() : "it is not a regular file";
    }
}

Result<std::string> read_file(const fs::path& path, size_t largest) {
    const auto refuse = [&](std::string_view why) {
        return fail(ErrorCode::load, fmt::format("cannot read '{}': {}", path.string(), why));
    };
    if (const std::string why = why_unreadable(path); !why.empty())
        return refuse(why);
    // Non-blocking: the path may have become a pipe since the check, and files of /proc may never have data.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (file.get() < 0)
        return refuse(system_reason(errno));
    auto bytes = read_all(file.get(), largest);
    if (bytes)
        return *std::move(bytes);
    return refuse(bytes.error() == EFBIG ? fmt::format("it is larger than {} MiB", largest >> 20)
                                         : system_reason(bytes.error()));
}

Result<std::string> read_text_file(const fs::path& path) {
    return read_file(path).and_then([&](std::string bytes) -> Result<std::string> {
        if (bytes.find('\0') != std::string::npos)
            return fail(ErrorCode::load,
                        fmt::format("'{}' is a binary file, not shader text", path.string()));
        return bytes;
    });
}

} // namespace tidemark
