#include "host/frame_files.hpp"

#include "base/encoding.hpp"
#include "media/video_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <new>
#include <system_error>

namespace tidemark::host {
namespace fs = std::filesystem;
namespace {

constexpr int k_most_digits = 20;
constexpr int k_default_digits = 4;
constexpr std::string_view k_face = "{}";

} // namespace

Result<OutputName> OutputName::parse(std::string_view pattern, size_t frame_count, std::string_view option) {
    const auto refuse = [&](std::string_view why) {
        return fail(ErrorCode::usage, fmt::format("{}{}: {}", option, pattern, why));
    };
    OutputName name;
    name.pattern_ = pattern;
    if (pattern == "-") {
        name.standard_output_ = true;
        return name;
    }
    if (pattern.empty())
        return refuse("give the name of a file, or - for standard output");
    if (image::is_video_name(name.pattern_)) {
        name.video_ = true;
        name.before_ = pattern;
        return name;
    }
    if (!image::check_picture_name(name.pattern_))
        return fail(
            ErrorCode::usage,
            fmt::format("cannot tell the format of '{}': its name must end in .png, .jpg, .jpeg, .tif, "
                        ".tiff, .exr or .hdr for pictures, in .mp4, .mkv, .webm, .mov, .gif or .webp for a "
                        "video, or in "
                        ".wav for the sound alone",
                        pattern));
    name.six_faces_ = pattern.find(k_face) != std::string_view::npos;
    for (size_t i = 0; i < pattern.size(); ++i) {
        std::string& part = name.numbered_ ? name.after_ : name.before_;
        const bool several = pattern.substr(i).starts_with("##");
        if (pattern[i] != '%' && !several) { // a single # is a character of the name
            part += pattern[i];
            continue;
        }
        if (pattern.substr(i).starts_with("%%")) {
            part += pattern[i++];
            continue;
        }
        if (name.numbered_)
            return refuse("it has two frame numbers; one is enough");
        name.numbered_ = true;
        if (several) {
            for (; i + 1 < pattern.size() && pattern[i + 1] == '#'; ++i)
                ++name.digits_;
            ++name.digits_;
            continue;
        }
        for (++i; i < pattern.size() && std::isdigit(static_cast<unsigned char>(pattern[i])); ++i)
            name.digits_ = std::min(name.digits_ * 10 + (pattern[i] - '0'), k_most_digits + 1);
        if (i >= pattern.size() || pattern[i] != 'd' || name.digits_ > k_most_digits)
            return refuse("write the frame number as %04d or ####");
    }
    if (!name.numbered_ && frame_count > 1)
        return refuse(
            fmt::format("{} frames need a frame number in the name, as in wave.%04d.png", frame_count));
    name.chosen_from_ =
        std::min(name.before_.find(k_face), name.numbered_ ? name.before_.size() : std::string::npos);
    return name;
}

OutputName OutputName::of_scene(const fs::path& scene, size_t frame_count) {
    OutputName name;
    name.numbered_ = frame_count > 1;
    name.digits_ = k_default_digits;
    name.after_ = name.numbered_ ? ".png" : "";
    name.before_ = name_after_scene(scene, name.numbered_ ? ".0000.png" : ".png");
    if (name.numbered_)
        name.before_.resize(name.before_.size() - std::string_view("0000.png").size());
    name.pattern_ = name.before_ + name.after_;
    name.chosen_from_ = 0;
    return name;
}

void OutputName::came_from_a_file() {
    const size_t slash = before_.rfind('/');
    chosen_from_ = std::min(chosen_from_, slash == std::string::npos ? 0 : slash + 1);
}

/// Follows a symbolic link in a name, or in its parent folders, that the user typed, but not in a part that
/// the program chose.
OutputPath OutputName::output_of(const std::string& name) const {
    if (chosen_from_ == std::string::npos)
        return OutputPath::typed(name).sparing(spared_);
    const size_t slash = name.rfind('/', chosen_from_);
    const size_t folder = chosen_from_ == 0 || slash == std::string::npos ? 0 : slash + 1;
    return (OutputPath::typed(name.substr(0, folder)) / name.substr(folder)).sparing(spared_);
}

OutputPath OutputName::of_frame(int frame) const {
    return output_of(numbered_ ? fmt::format("{}{:0{}}{}", before_, frame, digits_, after_) : before_);
}

OutputPath OutputName::of_face(int frame, size_t face) const {
    std::string name = of_frame(frame).string();
    return output_of(name.replace(name.find(k_face), k_face.size(), k_face_names[face]));
}

std::string name_after_scene(const fs::path& scene, std::string_view ending) {
    constexpr size_t k_longest = 255;
    std::error_code ignored;
    fs::path named = scene.lexically_normal();
    if (!named.has_filename()) // "folder/" has none
        named = named.parent_path();
    if (named.empty() || named == "." || named.filename() == "..")
        named = fs::weakly_canonical(scene, ignored);
    std::string stem = named == "-" ? "stdin" : named.stem().string(); // a scene from standard input
    if (stem.size() + ending.size() > k_longest)
        stem.resize(begin_of_character(stem, k_longest - ending.size()));
    return stem.append(ending);
}

std::optional<int> frame_of(const fs::path& file, const OutputName& pattern) {
    const std::string name = file.filename().string();
    const auto digit = [&](size_t i) {
        return i < name.size() && std::isdigit(static_cast<unsigned char>(name[i]));
    };
    for (size_t i = 0; i < name.size(); ++i) {
        if (!digit(i) || (i > 0 && digit(i - 1)))
            continue;
        size_t end = i;
        while (digit(end))
            ++end;
        for (size_t begin = i; begin < end; ++begin) { // the pattern may have digits of its own
            int number = 0;
            std::string_view digits(name.data() + begin, end - begin);
            if (consume_number(digits, number) &&
                pattern.of_frame(number).path().filename() == file.filename())
                return number;
        }
    }
    return std::nullopt;
}

Result<Sequence> find_sequence(std::string_view name) {
    std::error_code ignored;
    if (name.find_first_of("%#") == std::string_view::npos || fs::exists(name, ignored))
        return Sequence{{std::nullopt, fs::path(name)}};
    const auto pattern = TRY(OutputName::parse(name, 1, ""));
    if (!pattern.numbered())
        return fail(ErrorCode::load, fmt::format("there is no file '{}'", name));
    const fs::path folder = pattern.pattern().parent_path();
    Sequence found;
    for (fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, ignored), end;
         !ignored && entry != end; entry.increment(ignored))
        if (const auto number = frame_of(entry->path(), pattern))
            found[number] = pattern.of_frame(*number).path();
    if (found.empty())
        return fail(ErrorCode::load, fmt::format("there is no file '{}'", name));
    return found;
}

FrameWriter::FrameWriter(unsigned workers, unsigned waiting) : capacity_(waiting) {
    try {
        for (unsigned i = 0; i < workers; ++i)
            workers_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
        // At the system's thread limit, the threads started so far do the work, or else `push` itself.
    }
}

FrameWriter::~FrameWriter() {
    (void)finish();
}

bool FrameWriter::push(FrameFile frame) {
    std::unique_lock lock(mutex_);
    if (workers_.empty()) {
        write(frame, lock);
        return errors_.empty();
    }
    changed_.wait(lock, [&] { return queue_.size() < capacity_ || !errors_.empty(); });
    if (!errors_.empty())
        return false;
    queue_.push_back(std::move(frame));
    changed_.notify_all();
    return true;
}

bool FrameWriter::drain() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return (queue_.empty() && writing_ == 0) || !errors_.empty(); });
    return errors_.empty();
}

size_t FrameWriter::written() {
    const std::lock_guard lock(mutex_);
    return written_;
}

Result<void> FrameWriter::finish() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        changed_.notify_all();
    }
    for (std::thread& worker : workers_)
        worker.join();
    workers_.clear();
    if (errors_.empty())
        return {};
    return fail(std::min_element(errors_.begin(), errors_.end(), [](const auto& a, const auto& b) {
                    return a.first < b.first;
                })->second);
}

void FrameWriter::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return !queue_.empty() || closed_; });
        if (queue_.empty())
            return;
        const FrameFile frame = std::move(queue_.front());
        queue_.pop_front();
        changed_.notify_all();
        write(frame, lock);
    }
}

void FrameWriter::write(const FrameFile& frame, std::unique_lock<std::mutex>& lock) {
    ++writing_;
    lock.unlock();
    Result<void> written;
    try {
        written = frame.layers.empty() ? image::write_picture(frame.output, frame.image, frame.format)
                                       : image::write_layers(frame.output, frame.layers);
    } catch (const std::bad_alloc&) {
        written =
            fail(ErrorCode::write, "cannot write '" + frame.output.path().string() + "': out of memory");
    }
    lock.lock();
    --writing_;
    if (written)
        ++written_;
    else
        errors_.emplace_back(frame.frame, std::move(written.error()));
    changed_.notify_all();
}

} // namespace tidemark::host
