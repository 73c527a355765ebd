#include "gl_test.hpp"
#include "render/gl_program.hpp"
#include "render/gl_textures.hpp"

#include <gmock/gmock.h>

#include <numeric>

namespace tidemark::gl::program_gl_test {

using testing::HasSubstr;
using testing::UnorderedElementsAre;

constexpr const char* k_vertex = "#version 450 core\nvoid main() { gl_Position = vec4(0.0); }\n";

/// A program whose fragment shader declares something and makes a vec4 of it.
tl::expected<Program, std::string> linked(const std::string& declarations, const std::string& expression) {
    return Program::link(k_vertex,
                         fmt::format("#version 450 core\n{}\nout vec4 c;\nvoid main() {{ c = {}; }}\n",
                                     declarations, expression));
}

TEST(Program, reflection_lists_active_uniforms_only) {
    const auto program = linked(
        "uniform float used, unused; uniform vec3 list[4]; uniform sampler2D picture; uniform mat4 matrix;",
        "vec4(used) + vec4(list[2], 0.0) + texture(picture, vec2(0.0)) + matrix[1]");
    ASSERT_TRUE(program) << program.error();
    const Reflection& reflection = program->reflection();
    std::vector<std::string> names;
    for (const Uniform& uniform : reflection.uniforms)
        names.push_back(uniform.name);
    EXPECT_THAT(names, UnorderedElementsAre("used", "list", "picture", "matrix"));
    EXPECT_EQ(reflection.find("used")->type, GLenum(GL_FLOAT));
    EXPECT_EQ(reflection.find("list")->type, GLenum(GL_FLOAT_VEC3));
    EXPECT_GE(reflection.find("list")->length, 3); // drivers may cut elements after the last one used
    EXPECT_EQ(reflection.find("picture")->type, GLenum(GL_SAMPLER_2D));
    EXPECT_EQ(reflection.find("matrix")->type, GLenum(GL_FLOAT_MAT4));
    EXPECT_EQ(reflection.find("unused"), nullptr);
    EXPECT_FALSE(reflection.has("list[0]"));
}

TEST(Program, reflection_leaves_out_members_of_blocks) {
    const auto program =
        linked("layout(std140) uniform Block { vec4 inside; }; uniform vec4 outside;", "inside + outside");
    ASSERT_TRUE(program) << program.error();
    ASSERT_EQ(program->reflection().uniforms.size(), 1u);
    EXPECT_EQ(program->reflection().uniforms[0].name, "outside");
}

TEST(Program, without_uniforms_has_an_empty_reflection) {
    const auto program = linked("", "vec4(1.0)");
    ASSERT_TRUE(program);
    EXPECT_TRUE(program->reflection().uniforms.empty());
}

TEST(Program, error_is_the_drivers_log) {
    const auto fragment = linked("", "nothing");
    ASSERT_FALSE(fragment);
    EXPECT_THAT(fragment.error(), HasSubstr("nothing"));
    const auto vertex = Program::link("#version 450 core\nvoid main() { missing; }\n",
                                      "#version 450 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n");
    ASSERT_FALSE(vertex);
    EXPECT_THAT(vertex.error(), HasSubstr("missing"));
    const auto link = linked("vec4 f();", "f()");
    ASSERT_FALSE(link);
    EXPECT_THAT(link.error(), HasSubstr("f"));
}

TEST(Program, is_deleted_with_its_owner) {
    GLuint id = 0;
    {
        const auto program = linked("", "vec4(1.0)");
        ASSERT_TRUE(program);
        id = program->id();
        EXPECT_TRUE(glIsProgram(id));
    }
    EXPECT_FALSE(glIsProgram(id));
}

/// One uniform of some type, given 1, 2, 3, … and read back from the driver.
class SetUniform : public testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR)); }

    template <class T>
    std::vector<T> set_and_read(const std::string& type, size_t numbers, const std::string& as_vec4,
                                double scale = 1) {
        auto program = linked(fmt::format("uniform {} u;", type), as_vec4);
        EXPECT_TRUE(program) << type << ": " << program.error();
        if (!program)
            return {};
        const Uniform* uniform = program->reflection().find("u");
        EXPECT_NE(uniform, nullptr) << type;
        if (!uniform)
            return {};
        std::vector<double> values(numbers);
        std::iota(values.begin(), values.end(), 1.0);
        for (double& value : values)
            value *= scale;
        set_uniform(*program, *uniform, values);
        return read<T>(program->id(), uniform->location, numbers);
    }
    template <class T>
    static std::vector<T> read(GLuint program, GLint location, size_t numbers);
    template <class T>
    static std::vector<T> counted(size_t numbers, T scale = 1) {
        std::vector<T> values(numbers);
        for (size_t i = 0; i < numbers; ++i)
            values[i] = T(T(i + 1) * scale);
        return values;
    }
};

template <>
std::vector<float> SetUniform::read(GLuint program, GLint location, size_t numbers) {
    std::vector<float> values(numbers);
    glGetUniformfv(program, location, values.data());
    return values;
}
template <>
std::vector<double> SetUniform::read(GLuint program, GLint location, size_t numbers) {
    std::vector<double> values(numbers);
    glGetUniformdv(program, location, values.data());
    return values;
}
template <>
std::vector<GLint> SetUniform::read(GLuint program, GLint location, size_t numbers) {
    std::vector<GLint> values(numbers);
    glGetUniformiv(program, location, values.data());
    return values;
}
template <>
std::vector<GLuint> SetUniform::read(GLuint program, GLint location, size_t numbers) {
    std::vector<GLuint> values(numbers);
    glGetUniformuiv(program, location, values.data());
    return values;
}

TEST_F(SetUniform, floats) {
    EXPECT_EQ(set_and_read<float>("float", 1, "vec4(u)", 0.1), counted<float>(1, 0.1f));
    EXPECT_EQ(set_and_read<float>("vec2", 2, "u.xyxy", 0.5), counted<float>(2, 0.5f));
    EXPECT_EQ(set_and_read<float>("vec3", 3, "u.xyzx"), counted<float>(3));
    EXPECT_EQ(set_and_read<float>("vec4", 4, "u", -1), counted<float>(4, -1));
    EXPECT_EQ(set_and_read<float>("mat4", 16, "u * vec4(1.0)"), counted<float>(16));
}

TEST_F(SetUniform, integers) {
    EXPECT_EQ(set_and_read<GLint>("int", 1, "vec4(u)", -7), counted<GLint>(1, -7));
    EXPECT_EQ(set_and_read<GLint>("ivec2", 2, "vec4(u, u)"), counted<GLint>(2));
    EXPECT_EQ(set_and_read<GLint>("ivec3", 3, "vec4(u, 1)"), counted<GLint>(3));
    EXPECT_EQ(set_and_read<GLint>("ivec4", 4, "vec4(u)", 536870911), counted<GLint>(4, 536870911));
    EXPECT_EQ(set_and_read<GLuint>("uint", 1, "vec4(u)", 4294967295.0), counted<GLuint>(1, 4294967295u));
    EXPECT_EQ(set_and_read<GLuint>("uvec2", 2, "vec4(u, u)"), counted<GLuint>(2));
    EXPECT_EQ(set_and_read<GLuint>("uvec3", 3, "vec4(u, 1)"), counted<GLuint>(3));
    EXPECT_EQ(set_and_read<GLuint>("uvec4", 4, "vec4(u)"), counted<GLuint>(4));
}

TEST_F(SetUniform, booleans) {
    EXPECT_EQ(set_and_read<GLint>("bool", 1, "vec4(u)"), std::vector<GLint>({1}));
    EXPECT_EQ(set_and_read<GLint>("bool", 1, "vec4(u)", 0), std::vector<GLint>({0}));
    EXPECT_EQ(set_and_read<GLint>("bvec3", 3, "vec4(u, 1)"), std::vector<GLint>({1, 1, 1}));
}

TEST_F(SetUniform, doubles) {
    EXPECT_EQ(set_and_read<double>("double", 1, "vec4(u)", 0.1), counted<double>(1, 0.1));
    EXPECT_EQ(set_and_read<double>("dvec2", 2, "vec4(u.xyxy)", 0.1), counted<double>(2, 0.1));
    EXPECT_EQ(set_and_read<double>("dvec3", 3, "vec4(u, 1)", 0.1), counted<double>(3, 0.1));
    EXPECT_EQ(set_and_read<double>("dvec4", 4, "vec4(u)", 0.1), counted<double>(4, 0.1));
    EXPECT_EQ(set_and_read<double>("dmat4", 16, "vec4(u * dvec4(1.0))", 0.1), counted<double>(16, 0.1));
}

TEST_F(SetUniform, sampler_takes_its_unit) {
    EXPECT_EQ(set_and_read<GLint>("sampler2D", 1, "texture(u, vec2(0.0))", 3), std::vector<GLint>({3}));
}

TEST_F(SetUniform, a_shorter_array_sets_its_first_elements_only) {
    auto program = linked("uniform vec3 u[4];", "vec4(u[0] + u[1] + u[2] + u[3], 1.0)");
    ASSERT_TRUE(program) << program.error();
    const Uniform* uniform = program->reflection().find("u");
    ASSERT_EQ(uniform->length, 4);
    const auto element = [&](int i) { return read<float>(program->id(), uniform->location + i, 3); };
    set_uniform(*program, *uniform, counted<double>(12));
    EXPECT_EQ(element(3), (std::vector<float>{10, 11, 12}));
    set_uniform(*program, *uniform, counted<double>(6, -1.0));
    EXPECT_EQ(element(1), (std::vector<float>{-4, -5, -6}));
    EXPECT_EQ(element(2), (std::vector<float>{7, 8, 9}));
}

TEST_F(SetUniform, extra_values_are_ignored) {
    auto program = linked("uniform vec2 u;", "u.xyxy");
    ASSERT_TRUE(program);
    set_uniform(*program, *program->reflection().find("u"), counted<double>(4));
    EXPECT_EQ(read<float>(program->id(), program->reflection().find("u")->location, 2), counted<float>(2));
}

TEST(Target, is_cleared_and_reads_back_in_its_own_type) {
    for (const GLenum format : {GL_RGBA8, GL_RGBA32F}) {
        const auto target = make_render_target(make_texture({5, 3}, format, 1));
        ASSERT_TRUE(target);
        std::vector<std::byte> pixels(5 * 3 * (format == GL_RGBA8 ? 4 : 16), std::byte{7});
        read_pixels(*target, GL_RGBA, format == GL_RGBA8 ? GL_UNSIGNED_BYTE : GL_FLOAT, pixels);
        EXPECT_EQ(pixels, std::vector<std::byte>(pixels.size()));
    }
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST(Target, formats_that_cannot_be_rendered_fail) {
    EXPECT_FALSE(make_render_target(make_texture({5, 3}, GL_RGB9_E5, 1)));
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST(TextureObject, full_chain_of_mipmaps) {
    EXPECT_EQ(make_texture({1, 1}, GL_RGBA8, 0).levels, 1);
    EXPECT_EQ(make_texture({256, 256}, GL_RGBA8, 0).levels, 9);
    EXPECT_EQ(make_texture({257, 3}, GL_R32F, 0).levels, 9);
    EXPECT_EQ(make_texture({256, 256}, GL_RGBA8, 1).levels, 1);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST(TextureObject, rows_are_tightly_packed) {
    const Texture texture = make_texture({3, 2}, GL_R8, 1); // rows of 3 bytes: GL's default wants 4
    const std::vector<std::byte> bytes{std::byte{1}, std::byte{2}, std::byte{3},
                                       std::byte{4}, std::byte{5}, std::byte{6}};
    upload(texture, 0, GL_RED, GL_UNSIGNED_BYTE, bytes);
    std::vector<std::byte> back(6);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture.id(), 0, GL_RED, GL_UNSIGNED_BYTE, 6, back.data());
    EXPECT_EQ(back, bytes);
}

} // namespace tidemark::gl::program_gl_test
