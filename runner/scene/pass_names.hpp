// The names of passes: as people write them on tabs and files, and as we write them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tidemark::scene {

struct PassName {
    enum class Kind { common, buffer, cubemap, image, sound }; ///< in the order of drawing
    Kind kind = Kind::image;
    int number = 0; ///< of a buffer: 0 is A

    bool operator==(const PassName&) const = default;
};

/// `Buffer A`, `buf_a`, `BufA`, `Cube A`, `cubemap`, `Image`, `COMMON`: capitals, blanks, `_` and `-` do not
/// count.
std::optional<PassName> parse_pass_name(std::string_view name);

/// `Buffer A` for 0.
std::string buffer_name(int number);
/// `Buffer A`, `Image`: what pass_names() calls the first of its kind.
std::string to_string(const PassName& name);
/// `buffer_a.glsl` for `Buffer A`.
std::string file_name_of(std::string_view pass_name);

/// Whether the file's extension is one that holds a pass.
bool is_shader_file(const std::filesystem::path& file);

} // namespace tidemark::scene
