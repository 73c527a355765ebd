// A linked program and the uniforms the driver kept. Takes complete GLSL texts; reports the driver's log as
// it is.
#pragma once

#include "gl/handle.hpp"

#include <tl/expected.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::gl {

/// An active uniform of the default block. Arrays carry their bare name and their length.
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

/// A linked program as the driver writes it down for itself.
struct ProgramBinary {
    GLenum format = 0;
    std::string bytes;
};

class Program {
public:
    /// Compiles and links; the error is the driver's log.
    static tl::expected<Program, std::string> link(std::string_view vertex, std::string_view fragment);

    /// From the driver's own form; nothing when it is not the driver's, or not any more.
    static std::optional<Program> load(const ProgramBinary& binary);
    /// No bytes where the driver has no such form.
    ProgramBinary binary() const;

    GLuint id() const { return handle_.id(); }
    const Reflection& reflection() const { return reflection_; }

private:
    ProgramHandle handle_;
    Reflection reflection_;
};

/// A scalar or a vector; no matrix, no sampler.
bool is_number(GLenum type);

/// Gives `uniform` its value whatever its numeric type is. `values` hold `width` numbers for each element (0:
/// as many as its type has components; columns first); they are converted, surplus ones dropped, missing ones
/// 0. Elements that `values` do not reach keep what they have. Samplers take their unit.
void set_uniform(const Program& program, const Uniform& uniform, std::span<const double> values,
                 size_t width = 0);

} // namespace tidemark::gl
