#include "render/gl_program.hpp"

#include "base/encoding.hpp"
#include "base/folders.hpp"
#include "render/gl_context.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace tidemark::gl {
namespace {

/// Returns the log of a shader or a program; the functions are GL's for that kind of object.
std::string log_of(GLuint object, decltype(glGetShaderiv) get, decltype(glGetShaderInfoLog) get_log) {
    GLint length = 0;
    get(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(size_t(std::max(length, 1)), '\0');
    get_log(object, GLsizei(log.size()), &length, log.data());
    log.resize(size_t(length));
    return log;
}

tl::expected<ShaderHandle, std::string> compile(GLenum stage, std::string_view text) {
    ShaderHandle shader(glCreateShader(stage));
    const GLchar* characters = text.data();
    const auto length = GLint(text.size());
    glShaderSource(shader.id(), 1, &characters, &length);
    glCompileShader(shader.id());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_FALSE)
        return tl::unexpected(log_of(shader.id(), glGetShaderiv, glGetShaderInfoLog));
    return shader;
}

Reflection reflect(GLuint program) {
    Reflection reflection;
    GLint count = 0;
    GLint longest = 0;
    glGetProgramInterfaceiv(program, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
    glGetProgramInterfaceiv(program, GL_UNIFORM, GL_MAX_NAME_LENGTH, &longest);
    std::string name(size_t(std::max(longest, 1)), '\0');
    for (GLint i = 0; i < count; ++i) {
        constexpr GLenum k_wanted[] = {GL_TYPE, GL_ARRAY_SIZE, GL_LOCATION};
        GLint values[3] = {};
        glGetProgramResourceiv(program, GL_UNIFORM, GLuint(i), 3, k_wanted, 3, nullptr, values);
        if (values[2] < 0) // a member of a uniform block
            continue;
        GLsizei length = 0;
        glGetProgramResourceName(program, GL_UNIFORM, GLuint(i), GLsizei(name.size()), &length, name.data());
        std::string_view bare(name.data(), size_t(length));
        if (bare.ends_with("[0]"))
            bare.remove_suffix(3);
        reflection.uniforms.push_back({std::string(bare), GLenum(values[0]), values[1], values[2]});
    }
    return reflection;
}

enum class Scalar { float32, int32, uint32, float64 };

/// The component type and count of a uniform type; `columns` > 1 is a square matrix.
struct Shape {
    Scalar scalar;
    int components;
    int columns = 1;
};

Shape shape_of(GLenum type) {
    switch (type) {
    case GL_FLOAT: return {Scalar::float32, 1};
    case GL_FLOAT_VEC2: return {Scalar::float32, 2};
    case GL_FLOAT_VEC3: return {Scalar::float32, 3};
    case GL_FLOAT_VEC4: return {Scalar::float32, 4};
    case GL_FLOAT_MAT4: return {Scalar::float32, 4, 4};
    case GL_UNSIGNED_INT: return {Scalar::uint32, 1};
    case GL_UNSIGNED_INT_VEC2: return {Scalar::uint32, 2};
    case GL_UNSIGNED_INT_VEC3: return {Scalar::uint32, 3};
    case GL_UNSIGNED_INT_VEC4: return {Scalar::uint32, 4};
    case GL_DOUBLE: return {Scalar::float64, 1};
    case GL_DOUBLE_VEC2: return {Scalar::float64, 2};
    case GL_DOUBLE_VEC3: return {Scalar::float64, 3};
    case GL_DOUBLE_VEC4: return {Scalar::float64, 4};
    case GL_DOUBLE_MAT4: return {Scalar::float64, 4, 4};
    case GL_INT_VEC2:
    case GL_BOOL_VEC2: return {Scalar::int32, 2};
    case GL_INT_VEC3:
    case GL_BOOL_VEC3: return {Scalar::int32, 3};
    case GL_INT_VEC4:
    case GL_BOOL_VEC4: return {Scalar::int32, 4};
    default: return {Scalar::int32, 1}; // int, bool, and samplers by their unit
    }
}

/// The longest value the host ever sets: vec3 iChannelResolution[10].
constexpr size_t k_most_numbers = 30;

using Numbers = std::array<double, k_most_numbers>;

/// Copies elements of `width` numbers to elements of `per_element` numbers; missing ones are 0.
Numbers repacked(std::span<const double> values, size_t width, size_t per_element, size_t count) {
    Numbers numbers{};
    for (size_t element = 0; element < count; ++element)
        for (size_t i = 0; i < std::min({width, per_element, values.size() - element * width}); ++i)
            numbers[element * per_element + i] = values[element * width + i];
    return numbers;
}

/// Converts a number. Integer types wrap as in GLSL; for them NaN, infinities and values beyond 64 bits
/// become 0.
template <class T>
T number_of(double value) {
    if constexpr (std::is_floating_point_v<T>)
        return T(value);
    else
        return std::abs(value) < 0x1p63 ? T(int64_t(value)) : T(0);
}

template <class T>
std::array<T, k_most_numbers> converted(const Numbers& values) {
    std::array<T, k_most_numbers> numbers{};
    std::transform(values.begin(), values.end(), numbers.begin(), number_of<T>);
    return numbers;
}

template <class T>
using Setter = void (*)(GLuint, GLint, GLsizei, const T*);

template <class T>
void set_vector(GLuint program, const Uniform& uniform, int components, GLsizei count, const Numbers& values,
                const std::array<Setter<T>, 4>& setters) {
    setters[size_t(components - 1)](program, uniform.location, count, converted<T>(values).data());
}

/// Room for some thousand programs.
constexpr uint64_t k_most_bytes = uint64_t{64} << 20;

bool has_binaries() {
    GLint formats = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    return formats > 0;
}

/// Hashes all that determines the binary: our version, the driver, its extensions and the two texts.
std::string key_of(std::string_view vertex, std::string_view fragment) {
    const Capabilities driver = query_capabilities();
    std::string all;
    for (const std::string_view part :
         {std::string_view(TIDEMARK_VERSION), std::string_view(driver.vendor),
          std::string_view(driver.renderer), std::string_view(driver.version), vertex, fragment}) {
        all += part;
        all += '\0'; // does not occur in a part
    }
    for (const std::string& extension : query_extensions()) // a text asks for them by `#ifdef`
        all += extension + ' ';
    return sha256(std::as_bytes(std::span(all)));
}

std::optional<Program> recalled(const std::optional<std::string>& kept) {
    ProgramBinary binary;
    if (!kept || kept->size() <= sizeof binary.format)
        return std::nullopt;
    std::memcpy(&binary.format, kept->data(), sizeof binary.format);
    binary.bytes = kept->substr(sizeof binary.format);
    return Program::load(binary);
}

} // namespace

const Uniform* Reflection::find(std::string_view name) const {
    const auto found = std::find_if(uniforms.begin(), uniforms.end(),
                                    [&](const Uniform& uniform) { return uniform.name == name; });
    return found == uniforms.end() ? nullptr : &*found;
}

tl::expected<Program, std::string> Program::link(std::string_view vertex, std::string_view fragment) {
    const auto vertex_shader = compile(GL_VERTEX_SHADER, vertex);
    if (!vertex_shader)
        return tl::unexpected(vertex_shader.error());
    const auto fragment_shader = compile(GL_FRAGMENT_SHADER, fragment);
    if (!fragment_shader)
        return tl::unexpected(fragment_shader.error());
    Program program;
    program.handle_ = ProgramHandle(glCreateProgram());
    const GLuint id = program.id();
    glAttachShader(id, vertex_shader->id());
    glAttachShader(id, fragment_shader->id());
    glProgramParameteri(id, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    glLinkProgram(id);
    glDetachShader(id, vertex_shader->id());
    glDetachShader(id, fragment_shader->id());
    GLint linked = GL_FALSE;
    glGetProgramiv(id, GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE)
        return tl::unexpected(log_of(id, glGetProgramiv, glGetProgramInfoLog));
    program.reflection_ = reflect(id);
    return program;
}

std::optional<Program> Program::load(const ProgramBinary& binary) {
    Program program;
    program.handle_ = ProgramHandle(glCreateProgram());
    glProgramBinary(program.id(), binary.format, binary.bytes.data(), GLsizei(binary.bytes.size()));
    while (glGetError() != GL_NO_ERROR) { // an unknown format sets an error
    }
    GLint linked = GL_FALSE;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE)
        return std::nullopt;
    program.reflection_ = reflect(program.id());
    return program;
}

ProgramBinary Program::binary() const {
    GLint length = 0;
    glGetProgramiv(id(), GL_PROGRAM_BINARY_LENGTH, &length);
    ProgramBinary binary{0, std::string(size_t(std::max(length, 0)), '\0')};
    if (length > 0)
        glGetProgramBinary(id(), length, &length, &binary.format, binary.bytes.data());
    binary.bytes.resize(size_t(std::max(length, 0)));
    return binary;
}

bool is_number(GLenum type) {
    const Shape shape = shape_of(type);
    const bool scalar =
        type == GL_FLOAT || type == GL_INT || type == GL_UNSIGNED_INT || type == GL_BOOL || type == GL_DOUBLE;
    return shape.columns == 1 && (shape.components > 1 || scalar);
}

void set_uniform(const Program& program, const Uniform& uniform, std::span<const double> given,
                 size_t width) {
    const Shape shape = shape_of(uniform.type);
    const size_t per_element = size_t(shape.components) * size_t(shape.columns);
    if (width == 0)
        width = per_element;
    const size_t room = k_most_numbers / per_element;
    const auto count = GLsizei(std::min({size_t(uniform.length), (given.size() + width - 1) / width, room}));
    if (count == 0)
        return;
    const Numbers values = repacked(given, width, per_element, size_t(count));
    const GLuint id = program.id();
    if (shape.columns == 4 && shape.scalar == Scalar::float32)
        return glProgramUniformMatrix4fv(id, uniform.location, count, GL_FALSE,
                                         converted<float>(values).data());
    if (shape.columns == 4)
        return glProgramUniformMatrix4dv(id, uniform.location, count, GL_FALSE,
                                         converted<double>(values).data());
    switch (shape.scalar) {
    case Scalar::float32:
        return set_vector<float>(
            id, uniform, shape.components, count, values,
            {glProgramUniform1fv, glProgramUniform2fv, glProgramUniform3fv, glProgramUniform4fv});
    case Scalar::float64:
        return set_vector<double>(
            id, uniform, shape.components, count, values,
            {glProgramUniform1dv, glProgramUniform2dv, glProgramUniform3dv, glProgramUniform4dv});
    case Scalar::uint32:
        return set_vector<GLuint>(
            id, uniform, shape.components, count, values,
            {glProgramUniform1uiv, glProgramUniform2uiv, glProgramUniform3uiv, glProgramUniform4uiv});
    case Scalar::int32:
        return set_vector<GLint>(
            id, uniform, shape.components, count, values,
            {glProgramUniform1iv, glProgramUniform2iv, glProgramUniform3iv, glProgramUniform4iv});
    }
}

tl::expected<Program, std::string> link_or_recall(std::string_view vertex, std::string_view fragment) {
    const auto folder = user_cache_folder();
    if (!folder || !has_binaries())
        return Program::link(vertex, fragment);
    const FileCache cache(*folder / "programs", k_most_bytes);
    const std::string key = key_of(vertex, fragment);
    if (auto program = recalled(cache.find(key)))
        return *std::move(program);
    auto program = Program::link(vertex, fragment);
    if (!program)
        return program;
    if (const ProgramBinary binary = program->binary(); !binary.bytes.empty()) {
        const std::string_view format(reinterpret_cast<const char*>(&binary.format), sizeof binary.format);
        cache.keep(key, std::string(format).append(binary.bytes));
    }
    return program;
}

} // namespace tidemark::gl
