#include "cli/output_name.hpp"

#include "image/files/picture_file.hpp"
#include "image/files/video_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace tidemark::cli {
namespace fs = std::filesystem;
namespace {

constexpr int k_most_digits = 20;
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
                        ".tiff, .exr or .hdr for pictures, in .mp4, .webm or .gif for a video, or in "
                        ".wav for the sound alone",
                        pattern));
    name.six_faces_ = pattern.find(k_face) != std::string_view::npos;
    for (size_t i = 0; i < pattern.size(); ++i) {
        std::string& part = name.numbered_ ? name.after_ : name.before_;
        if (pattern[i] != '%' && pattern[i] != '#') {
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
        if (pattern[i] == '#') {
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
    return name;
}

fs::path OutputName::of_frame(int frame) const {
    if (!numbered_)
        return before_;
    return fmt::format("{}{:0{}}{}", before_, frame, digits_, after_);
}

fs::path file_of_face(std::string file, size_t face) {
    static constexpr std::array<std::string_view, 6> k_faces{"px", "nx", "py", "ny", "pz", "nz"};
    return file.replace(file.find(k_face), k_face.size(), k_faces[face]);
}

} // namespace tidemark::cli
