#include "gl_test.hpp"
#include "render/gl_context.hpp"
#include "render/gl_program.hpp"

#include <gmock/gmock.h>

namespace tidemark::gl::compiler_messages_gl_test {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// Compiles a text that every compiler rejects.
void compile(const std::string& name) {
    const auto linked = Program::link("#version 450 core\nvoid main() { gl_Position = vec4(0.0); }\n",
                                      "#version 450 core\nvoid main() { " + name + "; }\n");
    EXPECT_FALSE(linked);
}

TEST(CompilerMessages, collect_only_compiler_messages_during_their_lifetime) {
    if (query_capabilities().version.find("Mesa") == std::string::npos)
        GTEST_SKIP() << "what a driver says is its own affair; Mesa's compiler repeats its errors";
    compile("before");
    {
        CompilerMessages messages;
        constexpr std::string_view k_ours = "not the compiler's";
        glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_OTHER, 1, GL_DEBUG_SEVERITY_HIGH,
                             GLsizei(k_ours.size()), k_ours.data());
        EXPECT_THAT(messages.take(), IsEmpty());
        compile("while_it_lives");
        EXPECT_THAT(messages.take(), Contains(HasSubstr("while_it_lives")));
        EXPECT_THAT(messages.take(), IsEmpty());
    }
    compile("behind"); // must not write into the object that was destroyed
    CompilerMessages others;
    EXPECT_THAT(others.take(), IsEmpty());
}

} // namespace tidemark::gl::compiler_messages_gl_test
