#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <climits>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <mutex>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

namespace tidemark {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view k_part = ".part-";
constexpr size_t k_longest_name = 255;
constexpr size_t k_longest_extension = 16; ///< a longer ending is not a known format's
constexpr size_t k_machine_digits = 8;
constexpr size_t k_number_room = 33; ///< the machine, the process and the count, dashes between
constexpr int k_pipe_patience_ms = 10000;
constexpr int k_pipe_look_ms = 20;

tl::unexpected<Error> cannot_write(const OutputPath& output, std::string_view why) {
    return fail(ErrorCode::write, fmt::format("cannot write '{}': {}", output.string(), why));
}

tl::unexpected<Error> cannot_write(const OutputPath& output, int error_number) {
    return cannot_write(output, system_reason(error_number));
}

/// Returns -1 with errno on failure. Waits up to 10 s for a reader of a pipe.
int open_stream(const OutputPath::Place& place) {
    if (place.descriptor)
        return ::fcntl(*place.descriptor, F_DUPFD_CLOEXEC, 0);
    std::error_code ignored;
    const bool pipe = fs::is_fifo(place.path, ignored);
    for (int waited = 0;; waited += k_pipe_look_ms) {
        const int fd = ::open(place.path.c_str(), O_WRONLY | O_NONBLOCK | O_NOFOLLOW | O_NOCTTY | O_CLOEXEC);
        if (fd >= 0 || errno != ENXIO || !pipe || waited >= k_pipe_patience_ms)
            return fd;
        ::poll(nullptr, 0, k_pipe_look_ms);
    }
}

/// Calls `give` for each block to write, until it returns an empty one or an error.
template <typename Give>
Result<void> write_stream(const OutputPath& output, const OutputPath::Place& place, Give give) {
    Descriptor stream(open_stream(place));
    if (stream.get() < 0 && errno == ENXIO)
        return cannot_write(
            output, fmt::format("it is a pipe that no program read for {} s", k_pipe_patience_ms / 1000));
    if (stream.get() < 0)
        return cannot_write(output, errno);
    for (;;) {
        const Result<std::span<const std::byte>> block = give();
        if (!block)
            return fail(block.error());
        if (block->empty())
            break;
        if (const int error = write_all(stream.get(), *block))
            return cannot_write(output, error);
    }
    const int error = stream.close();
    return error ? cannot_write(output, error) : Result<void>();
}

/// Returns eight digits that identify this machine: on a shared disk, a process number means something only
/// with its machine.
const std::string& machine() {
    static const std::string digits = [] {
        std::array<char, HOST_NAME_MAX + 1> name{};
        ::gethostname(name.data(), name.size() - 1);
        return sha256(std::as_bytes(std::span(name))).substr(0, k_machine_digits);
    }();
    return digits;
}

/// Returns `.NAME.part-MACHINE-PID-COUNT.EXTENSION`; several processes and threads may write to one path.
std::string temporary_name(const std::string& stem, const std::string& extension) {
    static std::atomic<unsigned> count = 0;
    return fmt::format(".{}{}{}-{}-{}{}", stem, k_part, machine(), ::getpid(), ++count, extension);
}

/// The process that makes a temporary file, its machine and the stem of its output; process 0: not such a
/// file.
struct PartOf {
    pid_t process = 0;
    std::string machine{};
    std::string stem{};
};

PartOf part_of(const std::string& name) {
    const size_t part = name.rfind(k_part);
    if (name.empty() || name[0] != '.' || part == name.npos)
        return {};
    PartOf found;
    const size_t numbers = part + k_part.size();
    if (name.size() <= numbers + k_machine_digits || name[numbers + k_machine_digits] != '-')
        return {};
    found.machine = name.substr(numbers, k_machine_digits);
    const char* const end = name.data() + name.size();
    const auto [after, wrong] =
        std::from_chars(name.data() + numbers + k_machine_digits + 1, end, found.process);
    unsigned count = 0;
    if (wrong != std::errc() || after == end || *after != '-' ||
        std::from_chars(after + 1, end, count).ec != std::errc())
        return {};
    found.stem = name.substr(1, part - 1);
    return found;
}

/// Returns the stem without digits, since the frames of a sequence are one output.
std::string without_digits(std::string stem) {
    std::erase_if(stem, [](char c) { return c >= '0' && c <= '9'; });
    return stem;
}

std::string proc_text(pid_t process, std::string_view file) {
    std::ifstream stream(fmt::format("/proc/{}/{}", process, file));
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Returns the words of the process's `stat` from its state on; empty if the process is unknown.
std::string state_of(pid_t process) {
    const std::string text = proc_text(process, "stat");
    const size_t name_end = text.rfind(") "); // the name may have any character in it
    return name_end == text.npos ? std::string() : text.substr(name_end + 2);
}

/// Returns whether the process is dead, even if its parent has not waited for it yet.
bool has_ended(pid_t process) {
    if (::kill(process, 0) != 0 && errno == ESRCH)
        return true;
    const std::string state = state_of(process);
    return state.starts_with('Z') || state.starts_with('X');
}

/// Returns whether a SIGKILL waits for the process, which may write to a disk first, or the kernel takes it
/// down.
bool is_killed(pid_t process) {
    const std::string status = proc_text(process, "status");
    for (const std::string_view line : {"SigPnd:", "ShdPnd:"}) {
        const size_t at = status.find(line);
        uint64_t pending = 0;
        if (at != status.npos) {
            const size_t digits = std::min(status.find_first_not_of(" \t", at + line.size()), status.size());
            std::from_chars(status.data() + digits, status.data() + status.size(), pending, 16);
        }
        if (pending & (uint64_t{1} << (SIGKILL - 1)))
            return true;
    }
    constexpr unsigned long k_exiting = 4; // PF_EXITING, in the seventh word
    std::istringstream words(state_of(process));
    std::string word;
    for (int i = 0; i < 7; ++i)
        words >> word;
    return words && (std::strtoul(word.c_str(), nullptr, 10) & k_exiting) != 0;
}

/// Returns whether no process can still be writing the file: on this machine its process is dead, and the
/// file's lock is free.
bool is_abandoned(const fs::path& path, const PartOf& part) {
    if (part.machine == machine() && !has_ended(part.process))
        return false;
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat facts {};
    return file.get() >= 0 && ::fstat(file.get(), &facts) == 0 && S_ISREG(facts.st_mode) &&
           facts.st_uid == ::geteuid() &&
           (::flock(file.get(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK);
}

void remove_abandoned_in(const fs::path& folder, const std::string& output, StagedFile::Machines machines) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const PartOf part = part_of(entry->path().filename().string());
        const bool looked_at = machines == StagedFile::Machines::all || part.machine == machine();
        if (part.process > 0 && looked_at && without_digits(part.stem) == output &&
            is_abandoned(entry->path(), part))
            ::unlink(entry->path().c_str());
    }
}

/// Looks once for each output of a process, since a sequence writes to its folder a thousand times.
void remove_abandoned_once(const fs::path& folder, const std::string& stem) {
    static std::mutex mutex;
    static std::set<std::pair<fs::path, std::string>> seen;
    const std::string output = without_digits(stem);
    {
        const std::lock_guard lock(mutex);
        if (!seen.emplace(folder, output).second)
            return;
    }
    remove_abandoned_in(folder, output, StagedFile::Machines::ours);
}

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Overwrites the file in place, so that one with several names (hard links) stays one file.
Result<void> write_over(const OutputPath& output, const fs::path& path, std::span<const std::byte> bytes) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC));
    if (file.get() < 0)
        return cannot_write(output, errno);
    if (const int error = write_all(file.get(), bytes))
        return cannot_write(output, error);
    if (::ftruncate(file.get(), off_t(bytes.size())) != 0)
        return cannot_write(output, errno);
    const int error = file.close();
    return error ? cannot_write(output, error) : Result<void>();
}

} // namespace

void StagedFile::remove_abandoned(const OutputPath& output, Machines machines) {
    if (const auto place = output.place(); place && !place->stream)
        remove_abandoned_in(folder_of(place->path), without_digits(output.path().stem().string()), machines);
}

std::optional<StagedFile::Maker> StagedFile::other_maker_of(const OutputPath& output) {
    const auto place = output.place();
    if (!place || place->stream)
        return std::nullopt;
    std::error_code error;
    for (fs::directory_iterator entry(folder_of(place->path), error), end; !error && entry != end;
         entry.increment(error)) {
        const fs::path name = entry->path().filename();
        const PartOf part = part_of(name.string());
        if (part.process > 0 && part.process != ::getpid() && part.stem == output.path().stem() &&
            name.extension() == output.path().extension() && !is_abandoned(entry->path(), part))
            return Maker{part.process,
                         part.machine == machine() && (has_ended(part.process) || is_killed(part.process))};
    }
    return std::nullopt;
}

Result<void> StagedFile::check_is_there() const {
    return ::access(temporary_.c_str(), F_OK) == 0 ? Result<void>() : cannot_write(output_, errno);
}

Result<StagedFile> StagedFile::create(const OutputPath& output, std::string_view extension) {
    auto place = TRY(output.place());
    std::error_code ignored;
    if (fs::is_directory(place.path, ignored))
        return cannot_write(output, EISDIR);
    const fs::path name = output.path().filename(); // a link's target may have another extension
    std::string ending(extension.empty() ? name.extension().string() : extension);
    if (ending.size() > k_longest_extension)
        ending.clear();
    const std::string stem =
        name.stem().string().substr(0, k_longest_name - 1 - k_part.size() - k_number_room - ending.size());
    const fs::path folder = place.stream ? fs::temp_directory_path(ignored) : folder_of(place.path);
    remove_abandoned_once(folder, stem);
    StagedFile staged(output, std::move(place));
    TRY(staged.open(folder, stem, ending));
    return staged;
}

/// Tries another name if a file of that name exists: another user may have made it.
Result<void> StagedFile::open(const fs::path& folder, const std::string& stem, const std::string& extension) {
    constexpr int k_attempts = 1000;
    for (int i = 0; i < k_attempts; ++i) {
        fs::path path = folder == "." ? fs::path(temporary_name(stem, extension))
                                      : folder / temporary_name(stem, extension);
        leftover_ = Leftover::file(path);
        descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                             place_.stream ? 0600 : 0666);
        if (descriptor_ >= 0) {
            temporary_ = std::move(path);
            ::flock(descriptor_, LOCK_EX | LOCK_NB);
            return {};
        }
        leftover_.forget();
        if (errno != EEXIST)
            break;
    }
    return cannot_write(output_, errno);
}

StagedFile::StagedFile(StagedFile&& other) noexcept
    : output_(std::move(other.output_)), place_(std::move(other.place_)),
      temporary_(std::exchange(other.temporary_, {})), descriptor_(std::exchange(other.descriptor_, -1)),
      leftover_(std::move(other.leftover_)) {}

StagedFile::~StagedFile() {
    if (descriptor_ >= 0)
        ::close(descriptor_);
    if (!temporary_.empty())
        ::unlink(temporary_.c_str());
}

Result<void> StagedFile::write(std::span<const std::byte> bytes) {
    const int error = write_all(descriptor_, bytes);
    return error ? cannot_write(output_, error) : Result<void>();
}

Result<void> StagedFile::commit() {
    if (place_.stream) {
        ::lseek(descriptor_, 0, SEEK_SET);
        std::array<std::byte, 1 << 16> block;
        return write_stream(output_, place_, [&]() -> Result<std::span<const std::byte>> {
            const ssize_t count = ::read(descriptor_, block.data(), block.size());
            if (count < 0)
                return cannot_write(output_, errno);
            return std::span<const std::byte>(block.data(), size_t(count));
        });
    }
    if (::close(std::exchange(descriptor_, -1)) != 0)
        return cannot_write(output_, errno);
    std::error_code error;
    fs::rename(temporary_, place_.path, error);
    if (error)
        return cannot_write(output_, error.value());
    leftover_.forget();
    temporary_.clear();
    return {};
}

Result<void> write_file(const OutputPath& output, std::span<const std::byte> bytes) {
    auto place = TRY(output.place());
    if (place.stream)
        return write_stream(output, place, [&] { // everything at once, then an empty block
            return Result<std::span<const std::byte>>(std::exchange(bytes, {}));
        });
    auto staged = TRY(StagedFile::create(output));
    return staged.write(bytes).and_then([&] { return staged.commit(); });
}

Result<void> write_file(const OutputPath& output, std::string_view text) {
    return write_file(output, std::as_bytes(std::span(text)));
}

Result<void> replace_text(const OutputPath& output, std::string_view before, std::string_view after) {
    const auto place = TRY(output.place());
    struct stat facts {};
    if (::stat(place.path.c_str(), &facts) != 0)
        return cannot_write(output, errno);
    constexpr mode_t k_anybody_writes = 0222;
    if ((facts.st_mode & k_anybody_writes) == 0) // applies to root too, who may write everything
        return cannot_write(output, "it is read-only");
    if (::access(place.path.c_str(), W_OK) != 0)
        return cannot_write(output, errno);
    // written before any change, so that a full disk destroys nothing
    auto staged = TRY(StagedFile::create(output));
    TRY(staged.write(std::as_bytes(std::span(after))));
    const bool same_owner = ::fchown(staged.descriptor(), facts.st_uid, facts.st_gid) == 0;
    const bool same_mode = ::fchmod(staged.descriptor(), facts.st_mode & ~mode_t(S_IFMT)) == 0;
    if (const auto now = read_file(place.path); !now || *now != before)
        return fail(ErrorCode::write,
                    fmt::format("'{}' changed on disk meanwhile; nothing was written", output.string()));
    if (same_owner && same_mode && facts.st_nlink == 1)
        return staged.commit();
    return write_over(output, place.path, std::as_bytes(std::span(after)));
}

Result<void> check_writable(const OutputPath& output) {
    auto place = TRY(output.place());
    if (place.stream)
        return {};
    return StagedFile::create(output).map([](const StagedFile&) {});
}

Result<void> make_folder(const OutputPath& folder) {
    TRY(folder.check_links());
    std::error_code error;
    fs::create_directories(folder.path(), error);
    if (error)
        return fail(ErrorCode::write,
                    fmt::format("cannot make the folder '{}': {}", folder.string(), error.message()));
    return {};
}

} // namespace tidemark
