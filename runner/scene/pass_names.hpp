// Names of passes: parses the forms used on tabs and files, and writes the standard form.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tidemark::scene {

struct PassName {
    enum class Kind { common, buffer, cubemap, image, sound }; ///< in drawing order
    Kind kind = Kind::image;
    int number = 0; ///< for a buffer: 0 is A

    bool operator==(const PassName&) const = default;
};

/// Parses `Buffer A`, `buf_a`, `BufA`, `Cube A`, `cubemap`, `Image`, `COMMON`: case, blanks, `_` and `-` are
/// ignored.
std::optional<PassName> parse_pass_name(std::string_view name);

/// Returns `Buffer A` for 0.
std::string buffer_name(int number);
/// Returns `Buffer A`, `Image`: the name that pass_names() gives the first pass of a kind.
std::string to_string(const PassName& name);
/// Returns `buffer_a.glsl` for `Buffer A`.
std::string file_name_of(std::string_view pass_name);

/// Returns whether the file's extension is one of shader files: .glsl, .frag, .fs, .txt.
bool is_shader_file(const std::filesystem::path& file);

} // namespace tidemark::scene
