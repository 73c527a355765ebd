// Links programs from complete GLSL texts and lists their active uniforms. Errors are the driver's log,
// unchanged.
#pragma once

#include "render/gl_textures.hpp"

#include <tl/expected.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::gl {

/// An active uniform of the default block. An array has its name without `[0]`, and its length.
struct Uniform {
    std::string name;
    GLenum type = 0;
    int length = 1;
    GLint location = -1;
};

struct Reflection {
    std::vector<Uniform> uniforms;

    const Uniform* find(std::string_view name) const;
    bool has(std::string_view name) const { return find(name) != nullptr; }
};

/// A linked program in the driver's binary form.
struct ProgramBinary {
    GLenum format = 0;
    std::string bytes;
};

class Program {
public:
    /// Compiles and links; the error is the driver's log.
    static tl::expected<Program, std::string> link(std::string_view vertex, std::string_view fragment);

    /// Loads a program binary; returns nothing when the driver rejects it.
    static std::optional<Program> load(const ProgramBinary& binary);
    /// Returns the program binary; empty when the driver supports none.
    ProgramBinary binary() const;

    GLuint id() const { return handle_.id(); }
    const Reflection& reflection() const { return reflection_; }

private:
    ProgramHandle handle_;
    Reflection reflection_;
};

/// Returns whether the type is a scalar or a vector: neither a matrix nor a sampler.
bool is_number(GLenum type);

/// Sets `uniform`, whatever its numeric type. `values` hold `width` numbers per element (0: as many as the
/// type has components, column by column). They are converted; surplus numbers are dropped and missing ones
/// are 0. Elements beyond `values` keep their value. A sampler takes its unit.
void set_uniform(const Program& program, const Uniform& uniform, std::span<const double> values,
                 size_t width = 0);

// Caches linked programs on disk in the driver's binary form.

/// Links like Program::link, but takes the binary from the user's cache folder when this version of Tidemark
/// linked the same texts with this driver before, and stores a newly linked one. Compiles when the driver
/// supports no binaries or rejects the stored one.
tl::expected<Program, std::string> link_or_recall(std::string_view vertex, std::string_view fragment);

} // namespace tidemark::gl
