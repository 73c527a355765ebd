// Programs from an earlier run: used where they are whole and the driver's own, made anew where not.
#include "base/folders.hpp"
#include "gl_test.hpp"
#include "render/gl_program.hpp"

#include <cstdlib>

namespace tidemark::render::program_cache_gl_test {

constexpr const char* k_vertex = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }\n";
constexpr const char* k_fragment =
    "#version 330 core\nuniform float a[3];\nuniform sampler2D s;\nout vec4 c;\n"
    "void main() { c = vec4(a[1]) + texture(s, vec2(a[2])); }\n";

class ProgramCacheTest : public RenderTest {
protected:
    void SetUp() override {
        GLint formats = 0;
        glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
        if (formats == 0)
            GTEST_SKIP() << "this driver has no form of its own for a program";
        ::setenv("XDG_CACHE_HOME", cache_.path().c_str(), 1);
        ::unsetenv("TIDEMARK_CACHE");
    }
    void TearDown() override {
        ::unsetenv("XDG_CACHE_HOME");
        RenderTest::TearDown();
    }

    std::vector<fs::path> kept() const {
        std::vector<fs::path> files;
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(cache_ / "tidemark/programs", none))
            files.push_back(entry.path());
        return files;
    }

    TemporaryFolder cache_;
};

gl::Program linked(const char* fragment = k_fragment) {
    auto program = gl::link_or_recall(k_vertex, fragment);
    EXPECT_TRUE(program) << program.error();
    return *std::move(program);
}

void expect_good(const gl::Program& program) {
    EXPECT_EQ(program.reflection().uniforms.size(), 2u);
    ASSERT_TRUE(program.reflection().has("a"));
    EXPECT_EQ(program.reflection().find("a")->length, 3);
    EXPECT_TRUE(program.reflection().has("s"));
}

/// Expects that the program is compiled anew and kept in place of `bad`. Mesa writes a program twice with a
/// few other bytes now and then, so that only the size of `good` can be asked for.
void expect_kept_anew(const fs::path& file, const std::string& bad, const std::string& good) {
    expect_good(linked());
    const std::string anew = bytes_of(file);
    EXPECT_NE(anew, bad);
    EXPECT_EQ(anew.size(), good.size());
    expect_good(linked());
    EXPECT_EQ(bytes_of(file), anew) << "the driver takes what is kept";
}

TEST_F(ProgramCacheTest, a_program_is_stored_once_and_reused) {
    expect_good(linked());
    ASSERT_EQ(kept().size(), 1u);
    const auto before = fs::file_time_type::clock::now() - std::chrono::hours(1);
    fs::last_write_time(kept()[0], before);
    const std::string bytes = bytes_of(kept()[0]);
    expect_good(linked());
    EXPECT_EQ(kept().size(), 1u);
    EXPECT_GT(fs::last_write_time(kept()[0]), before) << "it was asked for";
    EXPECT_EQ(bytes_of(kept()[0]), bytes);
}

TEST_F(ProgramCacheTest, each_text_has_its_own_program) {
    expect_good(linked());
    expect_good(linked((std::string(k_fragment) + "\n").c_str()));
    EXPECT_EQ(kept().size(), 2u);
}

TEST_F(ProgramCacheTest, a_refused_program_is_recompiled_and_stored) {
    expect_good(linked());
    const fs::path file = kept().at(0);
    const std::string good = bytes_of(file);
    // Whole by its digest, but not what the driver wrote: an older driver's, say, or no format of its own.
    for (const size_t place : {size_t{64}, size_t{64 + 4 + 10}, good.size() - 9}) {
        std::string payload = good.substr(64);
        payload[place - 64] = char(payload[place - 64] ^ 0x5a);
        fs::remove(file);
        FileCache(file.parent_path(), 1 << 20).keep(file.filename().string(), payload);
        SCOPED_TRACE(place);
        expect_kept_anew(file, bytes_of(file), good);
    }
    for (const std::string& bytes : {std::string(), std::string("four"), good.substr(64, 40)}) {
        FileCache(file.parent_path(), 1 << 20).keep(file.filename().string(), bytes);
        expect_kept_anew(file, bytes_of(file), good);
    }
}

TEST_F(ProgramCacheTest, a_damaged_file_is_recompiled_and_stored) {
    expect_good(linked());
    const fs::path file = kept().at(0);
    const std::string good = bytes_of(file);
    save_in_place(file, good.substr(0, good.size() / 2));
    expect_kept_anew(file, bytes_of(file), good);
}

TEST_F(ProgramCacheTest, failed_programs_are_not_stored) {
    const auto program = gl::link_or_recall(k_vertex, "#version 330 core\nvoid main() { nothing(); }\n");
    ASSERT_FALSE(program);
    EXPECT_NE(program.error().find("nothing"), std::string::npos);
    EXPECT_TRUE(kept().empty());
}

TEST_F(ProgramCacheTest, can_be_switched_off_and_works_without_a_folder) {
    ::setenv("TIDEMARK_CACHE", "off", 1);
    expect_good(linked());
    EXPECT_TRUE(kept().empty());
    ::unsetenv("TIDEMARK_CACHE");
    save_in_place(cache_ / "file");
    ::setenv("XDG_CACHE_HOME", (cache_ / "file").c_str(), 1);
    expect_good(linked());
    expect_good(linked());
}

TEST_F(ProgramCacheTest, cached_programs_draw_the_same_pictures) {
    const std::string text = "void mainImage(out vec4 c, in vec2 p) {\n"
                             "    c = vec4(sin(p.x * iTime), texture(iChannel0, p / 99.0).gb, 1.0);\n}\n";
    Renderer compiled = renderer(text, {31, 17});
    const size_t programs = kept().size();
    EXPECT_GT(programs, 0u);
    Renderer recalled = renderer(text, {31, 17});
    EXPECT_EQ(kept().size(), programs);
    EXPECT_EQ(frame(recalled, inputs_of_frame(5, 60)), frame(compiled, inputs_of_frame(5, 60)));
}

} // namespace tidemark::render::program_cache_gl_test
