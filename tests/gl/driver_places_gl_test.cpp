// Lines and columns of the driver at hand: a word that is not declared, put anywhere in texts of blanks,
// comments, joined lines, macros and edits, is found where it stands, or without a column.
#include "base/mapped_text.hpp"
#include "gl_test.hpp"
#include "render/gl_context.hpp"
#include "render/gl_program.hpp"
#include "shader/driver_log.hpp"

#include <random>

namespace tidemark::render::driver_places_gl_test {

class Writer {
public:
    explicit Writer(unsigned seed) : random_(seed) {}

    /// A text with one word that nothing declares.
    std::string text(bool with_macros) {
        std::string text =
            "#version 450 core\nout vec4 colour;\n#define CALL(x, y) ((x) + (y))\n#define ONE 1.0\n"
            "#define NOTHING\n#ifdef NEVER\n#define UNUSED(x) x\n#endif\n\nvoid main() {\n";
        const int statements = 12;
        const int wrong = roll(statements);
        for (int i = 0; i < statements; ++i) {
            text += blank() + "float" + space() + fmt::format("v{}", i) + blank() + "=";
            const int terms = 1 + roll(4);
            const int wrong_term = i == wrong ? roll(terms) : -1;
            for (int term = 0; term < terms; ++term)
                text += (term > 0 ? "+" : "") + blank() +
                        (term == wrong_term ? "undeclared_word" : value(with_macros)) + blank();
            text += ";";
            if (roll(3) > 0)
                text += "\n";
        }
        return text + "\n}\n";
    }

    /// Returns edits of the text before and after the word, but not of the word.
    std::vector<text::Edit> edits(const std::string& text) {
        std::vector<text::Edit> edits;
        for (size_t at = text.find("void main"); (at = text.find("1.", at + 1)) != text.npos;)
            if (text[at + 2] != '5' && roll(3) == 0)
                edits.push_back({at, at + 2, roll(2) ? "2.25" : "float( 3 )"});
        return edits;
    }

private:
    int roll(int sides) { return std::uniform_int_distribution(0, sides - 1)(random_); }
    std::string space() {
        static const char* const k_spaces[] = {" ",         "\t",
                                               "   ",       " \t ",
                                               "/* c */",   " /*\xC3\xB6*/ ",
                                               " \\\n ",    "\n  ",
                                               " // end\n", "/* two\n lines */"};
        return k_spaces[roll(10)];
    }
    std::string blank() { return roll(2) ? "" : space(); }
    std::string value(bool with_macros) {
        if (with_macros && roll(3) == 0) {
            const int which = roll(3);
            return which == 0   ? "ONE"
                   : which == 1 ? "NOTHING" + space() + "1.5"
                                : "CALL(" + blank() + "1." + blank() + "," + blank() + "ONE" + blank() + ")";
        }
        return roll(2) ? "1." : "max(" + blank() + "1.," + blank() + "2.0)";
    }

    std::mt19937 random_;
};

bool is_mesa() {
    return gl::query_capabilities().version.find("Mesa") != std::string::npos;
}

/// How many of so many texts had the word's column.
int found(bool with_macros, int texts) {
    int known = 0;
    for (int seed = 0; seed < texts; ++seed) {
        Writer writer{unsigned(seed)};
        text::MappedText source;
        source.append_generated("\n\n");
        const std::string text = writer.text(with_macros);
        // `#version` must come first: what stands before is blank.
        source.append(text, "t.glsl", 1);
        const size_t at = text.find("undeclared_word");
        const int line = 1 + int(std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n'));
        const int column = int(at - (text.rfind('\n', at) + 1)) + 1;
        std::vector<text::Edit> edits = writer.edits(text);
        for (text::Edit& edit : edits) {
            edit.begin += 2;
            edit.end += 2;
        }
        source.apply(edits);
        const auto linked =
            gl::Program::link("#version 450 core\nvoid main() { gl_Position = vec4(0.0); }\n", source.text());
        EXPECT_FALSE(linked);
        if (linked)
            continue;
        const auto people = glsl::for_people(glsl::parse_driver_log(linked.error(), source));
        const SourceLocation where = people.at(0).where;
        EXPECT_EQ(people.at(0).message, "`undeclared_word' undeclared") << linked.error() << text;
        EXPECT_EQ(where.line, line) << linked.error() << source.text();
        EXPECT_TRUE(where.column == 0 || where.column == column)
            << where.column << " is not " << column << "\n"
            << linked.error() << source.text();
        known += where.column == column;
        if (testing::Test::HasFailure())
            break;
    }
    return known;
}

TEST(DriverPlaces, columns_are_exact_without_macros) {
    if (!is_mesa())
        GTEST_SKIP() << "columns are Mesa's";
    EXPECT_EQ(found(false, 400), 400);
}

TEST(DriverPlaces, columns_are_exact_or_missing_with_macros) {
    if (!is_mesa())
        GTEST_SKIP() << "columns are Mesa's";
    EXPECT_EQ(found(true, 400), 400) << "the word is there once";
}

} // namespace tidemark::render::driver_places_gl_test
