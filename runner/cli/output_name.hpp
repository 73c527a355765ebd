// File names for frames: `out/wave.%04d.png`, `out/wave.####.png`, one name for one picture, or for a video;
// `sky_{}.png` for the six faces of a cube.
#pragma once

#include "base/result.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace tidemark::cli {

class OutputName {
public:
    /// `pattern` holds at most one frame number: `%d`, `%04d`, or a run of `#` (one digit each); `%%` is a
    /// percent sign. Fails (ErrorCode::usage) on a form we do not write, and on several frames under one
    /// name. `option` stands before the pattern in the error.
    static Result<OutputName> parse(std::string_view pattern, size_t frame_count,
                                    std::string_view option = "-o ");

    std::filesystem::path of_frame(int frame) const;
    /// `-`: raw frames on standard output.
    bool standard_output() const { return standard_output_; }
    /// All frames go into one file.
    bool video() const { return video_; }
    /// A picture's name has `{}` in it: each face of a cube is a file.
    bool six_faces() const { return six_faces_; }
    const std::filesystem::path& pattern() const { return pattern_; }

private:
    std::filesystem::path pattern_;
    std::string before_;
    std::string after_;
    int digits_ = 0;
    bool numbered_ = false;
    bool standard_output_ = false;
    bool video_ = false;
    bool six_faces_ = false;
};

/// What stands for `{}` in `file` (its first one): px nx py ny pz nz, as in names of cubemaps that scenes
/// read.
std::filesystem::path file_of_face(std::string file, size_t face);

} // namespace tidemark::cli
