// File names for frames: `out/wave.%04d.png`, `out/wave.####.png`, one name for one picture, or for a video;
// `sky_{}.png` for the six faces of a cube.
#pragma once

#include "base/output_path.hpp"
#include "base/result.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

/// Of a cube, in OpenGL's order.
inline constexpr std::array<std::string_view, 6> k_face_names{"px", "nx", "py", "ny", "pz", "nz"};

class OutputName {
public:
    /// `pattern` holds at most one frame number: `%d`, `%04d`, or a run of `#` (one digit each); `%%` is a
    /// percent sign. Fails (ErrorCode::usage) on a form we do not write, and on several frames under one
    /// name. `option` stands before the pattern in the error.
    static Result<OutputName> parse(std::string_view pattern, size_t frame_count,
                                    std::string_view option = "-o ");

    /// Of what SCENE makes where nothing was said: `wave.png`, `wave.0007.png`. What is a pattern elsewhere
    /// stands for itself.
    static OutputName of_scene(const std::filesystem::path& scene, size_t frame_count);

    OutputPath of_frame(int frame) const;
    /// px nx py ny pz nz for `{}`, as in names of cubemaps that scenes read.
    OutputPath of_face(int frame, size_t face) const;
    /// `-`: raw frames on standard output.
    bool standard_output() const { return standard_output_; }
    /// All frames go into one file.
    bool video() const { return video_; }
    /// A picture's name has `{}` in it: each face of a cube is a file.
    bool six_faces() const { return six_faces_; }
    const std::filesystem::path& pattern() const { return pattern_; }
    /// Files that are read and must not be replaced.
    void spare(std::vector<std::filesystem::path> files) { spared_ = std::move(files); }
    /// The name was read from a file: a person typed its folder at most, and a link under the name is not
    /// followed.
    void came_from_a_file();

private:
    OutputPath output_of(const std::string& name) const;

    std::filesystem::path pattern_;
    std::string before_;
    std::string after_;
    int digits_ = 0;
    bool numbered_ = false;
    bool standard_output_ = false;
    bool video_ = false;
    bool six_faces_ = false;
    size_t chosen_from_ = std::string::npos; ///< where in a name that begins which nobody typed as it is
    std::vector<std::filesystem::path> spared_;
};

/// The name of the scene with this ending, no longer than a file's name may be.
std::string name_after_scene(const std::filesystem::path& scene, std::string_view ending);

} // namespace tidemark::cli
