// Each tests/cases/dialect/<name>.glsl must link in one of the dialects offered for it, and where a line
// `//: pixel R G B [A]` says so, draw that colour. `//: buffer`, `cubemap`, `sound` name the kind of pass;
// `//: keyboard` asks for the keyboard helpers. Every text stands for a class of real ShaderToy texts.
#include "base/file.hpp"
#include "base/mapped_text.hpp"
#include "host/gl_context.hpp"
#include "render/gl_program.hpp"
#include "shader/driver_log.hpp"
#include "shader/pass_reading.hpp"
#include "shader/shader_source.hpp"
#include "support/cases.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

namespace tidemark::glsl::dialect_gl_test {

namespace fs = std::filesystem;

const fs::path k_folder = fs::path(TIDEMARK_SOURCE_DIR) / "tests/cases/dialect";

struct Case {
    scene::Scene scene;
    std::vector<int> pixel;
};

Case read_case(const std::string& name) {
    Case result;
    result.scene.passes.resize(1);
    scene::Pass& pass = result.scene.passes[0];
    const auto bytes = read_file(k_folder / (name + ".glsl"));
    const std::string text = text::with_plain_line_ends(bytes.value_or(""));
    pass.text.append(text, name, 1);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string mark, option;
        if (!(words >> mark >> option) || mark != "//:")
            continue;
        for (int level = 0; option == "pixel" && words >> level;)
            result.pixel.push_back(level);
        if (option == "buffer")
            pass.kind = scene::PassKind::buffer;
        else if (option == "cubemap")
            pass.kind = scene::PassKind::cubemap;
        else if (option == "sound")
            pass.kind = scene::PassKind::sound;
        else if (option == "keyboard")
            pass.keyboard_helpers = true;
    }
    return result;
}

/// The first dialect that links, as the Renderer looks for it; else every driver's words.
tl::expected<gl::Program, std::string> link(const scene::Scene& scene, Precision precision) {
    const PassReading reading(scene, scene.passes[0]);
    std::string words;
    const auto attempt = [&](const Dialect& dialect) {
        const text::MappedText source = reading.assemble(dialect).value().source;
        auto program = gl::Program::link(vertex_shader(dialect.version), source.text());
        if (!program)
            words += to_string(dialect) + "\n" + program.error();
        return std::pair(std::move(program), source);
    };
    for (Dialect dialect : reading.dialects(precision)) {
        auto [program, source] = attempt(dialect);
        if (program)
            return std::move(program);
        for (const ChannelKinds& kinds :
             channel_kinds_to_try(scene, scene.passes[0], source, program.error())) {
            dialect.channels = kinds;
            if (auto guessed = attempt(dialect).first)
                return guessed;
        }
    }
    return tl::unexpected(words);
}

/// Returns the pixel that `program` draws; iResolution is 1.
std::vector<int> draw(const gl::Program& program) {
    GLuint framebuffer = 0, colours = 0, vertices = 0;
    glCreateFramebuffers(1, &framebuffer);
    glCreateRenderbuffers(1, &colours);
    glCreateVertexArrays(1, &vertices);
    glNamedRenderbufferStorage(colours, GL_RGBA8, 1, 1);
    glNamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colours);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, 1, 1);
    const double ones[] = {1, 1, 1};
    if (const gl::Uniform* resolution = program.reflection().find("iResolution"))
        gl::set_uniform(program, *resolution, ones);
    // Samplers of several kinds must not share a unit.
    double unit = 0;
    for (const gl::Uniform& uniform : program.reflection().uniforms)
        if (uniform.type == GL_SAMPLER_2D || uniform.type == GL_SAMPLER_CUBE ||
            uniform.type == GL_SAMPLER_3D) {
            const double units[] = {unit++};
            gl::set_uniform(program, uniform, units);
        }
    glUseProgram(program.id());
    glBindVertexArray(vertices);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    unsigned char bytes[4] = {};
    glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
    glDeleteVertexArrays(1, &vertices);
    glDeleteRenderbuffers(1, &colours);
    glDeleteFramebuffers(1, &framebuffer);
    return {bytes[0], bytes[1], bytes[2], bytes[3]};
}

class DialectCase : public testing::TestWithParam<std::string> {
protected:
    void expect_to_link_and_draw(Precision precision) const;
};

void DialectCase::expect_to_link_and_draw(Precision precision) const {
    const auto context = host::HeadlessContext::create();
    if (!context)
        GTEST_SKIP() << context.error().message;
    const Case example = read_case(GetParam());
    const auto program = link(example.scene, precision);
    ASSERT_TRUE(program) << program.error();
    if (example.pixel.empty())
        return;
    std::vector<int> drawn = draw(*program);
    drawn.resize(example.pixel.size());
    EXPECT_EQ(drawn, example.pixel);
}

TEST_P(DialectCase, links_and_draws) {
    expect_to_link_and_draw(Precision::single);
}

TEST_P(DialectCase, links_and_draws_in_double_precision) {
    expect_to_link_and_draw(Precision::promoted);
}

INSTANTIATE_TEST_SUITE_P(Text, DialectCase, testing::ValuesIn(case_names(k_folder)),
                         [](const auto& each) { return each.param; });

} // namespace tidemark::glsl::dialect_gl_test
