#include "base/file.hpp"

#include "base/descriptor.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace tidemark {
namespace fs = std::filesystem;
namespace {

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
                   ? fmt::format("it is a link to '{}', where there is nothing", target)
                   : fmt::format("'{}' is a link to '{}', where there is nothing", way.string(), target);
    }
    return "no such file";
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
