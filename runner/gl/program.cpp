#include "gl/program.hpp"

#include <algorithm>

namespace tidemark::gl {
namespace {

std::string shader_log(GLuint shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(size_t(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader, GLsizei(log.size()), &length, log.data());
    log.resize(size_t(length));
    return log;
}

std::string program_log(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(size_t(std::max(length, 1)), '\0');
    glGetProgramInfoLog(program, GLsizei(log.size()), &length, log.data());
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
        return tl::unexpected(shader_log(shader.id()));
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
        return tl::unexpected(program_log(id));
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

} // namespace tidemark::gl
