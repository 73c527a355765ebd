#include "base/tokens.hpp"

#include <gmock/gmock.h>

#include <string>

namespace tidemark::text::tokens_test {

using testing::ElementsAre;

/// Texts and kinds, as `identifier:a number:1`.
std::string kinds(std::string_view text) {
    constexpr const char* k_names[] = {"identifier", "number", "string", "punctuation"};
    std::string listed;
    for (const Token& token : tokenize(text))
        listed += std::string(listed.empty() ? "" : " ") + k_names[size_t(token.kind)] + ":" +
                  std::string(token.text);
    return listed;
}

std::vector<std::string> texts(std::string_view text) {
    std::vector<std::string> found;
    for (const Token& token : tokenize(text))
        found.emplace_back(token.text);
    return found;
}

/// `text@line:column` of every token.
std::vector<std::string> places(std::string_view text) {
    std::vector<std::string> found;
    for (const Token& token : tokenize(text))
        found.push_back(std::string(token.text) + "@" + std::to_string(token.line) + ":" +
                        std::to_string(token.column));
    return found;
}

std::vector<std::string> first_on_line(std::string_view text) {
    std::vector<std::string> found;
    for (const Token& token : tokenize(text))
        if (token.first_on_line)
            found.emplace_back(token.text);
    return found;
}

std::vector<std::string> glued(std::string_view text) {
    std::vector<std::string> found;
    for (const Token& token : tokenize(text))
        if (token.glued)
            found.emplace_back(token.text);
    return found;
}

TEST(Tokens, kinds_of_tokens) {
    EXPECT_EQ(kinds("float _x9=vec3(1.0).x;"),
              "identifier:float identifier:_x9 punctuation:= identifier:vec3 "
              "punctuation:( number:1.0 punctuation:) punctuation:. "
              "identifier:x punctuation:;");
    EXPECT_EQ(kinds("#include \"a b\" 'c'"), "punctuation:# identifier:include string:\"a b\" string:'c'");
}

TEST(Tokens, empty_texts_have_no_tokens) {
    EXPECT_THAT(texts(""), ElementsAre());
    EXPECT_THAT(texts(" \t\r\n\v\f\\\n"), ElementsAre());
    EXPECT_THAT(texts("// only a comment"), ElementsAre());
    EXPECT_THAT(texts("/* only a comment */"), ElementsAre());
}

TEST(Tokens, numbers_of_every_form) {
    for (const char* number : {"0", "42", "1.", "1.5", ".5", "1e3", "1.e3", "1.5e+3", ".5e-3f", "1.5F", "1.f",
                               "0x1Fu", "0XffU", "7u", "1.0lf", "1.0LF", "007"})
        EXPECT_EQ(kinds(number), std::string("number:") + number);
}

TEST(Tokens, numbers_end_at_a_second_point) {
    EXPECT_THAT(texts("1..xxx"), ElementsAre("1.", ".", "xxx"));
    EXPECT_THAT(texts("1.xx"), ElementsAre("1.", "xx"));
    EXPECT_THAT(texts("1.5.5"), ElementsAre("1.5", ".5"));
    EXPECT_THAT(texts("1e"), ElementsAre("1", "e"));
    EXPECT_THAT(texts("1e+x"), ElementsAre("1", "e", "+", "x"));
    EXPECT_THAT(texts("a.x"), ElementsAre("a", ".", "x"));
    EXPECT_THAT(texts("1-2"), ElementsAre("1", "-", "2"));
    EXPECT_THAT(texts("0x1.xx"), ElementsAre("0x1", ".", "xx"));
}

TEST(Tokens, comments_are_skipped) {
    EXPECT_THAT(texts("a // b\nc /* d\ne */ f /**/ g /*/ h */ i"), ElementsAre("a", "c", "f", "g", "i"));
    EXPECT_THAT(texts("a / b /= c"), ElementsAre("a", "/", "b", "/", "=", "c"));
    EXPECT_THAT(texts("// /* a\nb"), ElementsAre("b"));
    EXPECT_THAT(texts("/* // */ b"), ElementsAre("b"));
}

TEST(Tokens, an_unclosed_comment_takes_the_rest) {
    EXPECT_THAT(texts("a /* b\nc"), ElementsAre("a"));
    EXPECT_THAT(texts("a /*"), ElementsAre("a"));
    EXPECT_THAT(texts("a /*/"), ElementsAre("a"));
    EXPECT_THAT(texts("a //"), ElementsAre("a"));
}

TEST(Tokens, a_line_comment_continues_after_a_backslash) {
    EXPECT_THAT(places("a // b \\\n c\nd"), ElementsAre("a@1:1", "d@3:1"));
    EXPECT_THAT(places("a // b \\ \nc"), ElementsAre("a@1:1", "c@2:1"));
}

TEST(Tokens, places_are_counted_from_1) {
    EXPECT_THAT(places("a b\n  c\n\n\td"), ElementsAre("a@1:1", "b@1:3", "c@2:3", "d@4:2"));
    EXPECT_THAT(places("/* \n\n */ a"), ElementsAre("a@3:5"));
    EXPECT_THAT(places("a\\\n b"), ElementsAre("a@1:1", "b@2:2"));
}

TEST(Tokens, offsets_point_into_the_text) {
    const std::string text = "ab /* c */ 1.5;\n\"d\"";
    size_t last = 0;
    for (const Token& token : tokenize(text)) {
        EXPECT_EQ(text.substr(token.begin, token.text.size()), token.text);
        EXPECT_EQ(token.text.data(), text.data() + token.begin);
        EXPECT_EQ(token.end(), token.begin + token.text.size());
        EXPECT_GE(token.begin, last);
        last = token.end();
    }
    EXPECT_EQ(last, text.size());
}

TEST(Tokens, first_on_line_follows_joined_lines) {
    EXPECT_THAT(first_on_line("a b\nc d"), ElementsAre("a", "c"));
    EXPECT_THAT(first_on_line("  #define A \\\n 1\n# B"), ElementsAre("#", "#"));
    EXPECT_THAT(first_on_line("/* a\n */ # b"), ElementsAre("#"));
    EXPECT_THAT(first_on_line("a /*\n*/ b\nc"), ElementsAre("a", "c"));
    EXPECT_THAT(first_on_line("a // \\\n b\nc"), ElementsAre("a", "c"));
}

TEST(Tokens, glued_tokens_have_no_space_between) {
    EXPECT_THAT(glued("a(b) c (d)"), ElementsAre("(", "b", ")", "d", ")"));
    EXPECT_THAT(glued("a/**/b"), ElementsAre());
    EXPECT_THAT(glued("a\\\nb"), ElementsAre());
    EXPECT_THAT(glued("# iUniform #iUniform"), ElementsAre("iUniform"));
}

TEST(Tokens, strings_end_on_their_line) {
    EXPECT_EQ(kinds("\"a\\\"b\""), "string:\"a\\\"b\"");
    EXPECT_EQ(kinds("\"\""), "string:\"\"");
    EXPECT_EQ(kinds("\"it's\""), "string:\"it's\"");
    EXPECT_EQ(kinds("don't\n'"), "identifier:don punctuation:' identifier:t punctuation:'");
    EXPECT_EQ(kinds("\"a\n\""), "punctuation:\" identifier:a punctuation:\"");
    EXPECT_EQ(kinds("\"a\\"), "punctuation:\" identifier:a punctuation:\\");
}

TEST(Tokens, a_joined_line_ends_a_string) {
    EXPECT_THAT(places("\"a\\\nb\" c\nd"),
                ElementsAre("\"@1:1", "a@1:2", "b@2:1", "\"@2:2", "c@2:4", "d@3:1"));
}

TEST(Tokens, any_byte_is_a_token) {
    EXPECT_THAT(texts(std::string_view("a\0b", 3)), ElementsAre("a", std::string(1, '\0'), "b"));
    EXPECT_THAT(texts("\xc3\xa9$@`\\"), ElementsAre("\xc3", "\xa9", "$", "@", "`", "\\"));
    EXPECT_THAT(texts(std::string_view("a\0", 2)), ElementsAre("a", std::string(1, '\0')));
}

TEST(Tokens, end_of_directive_is_the_next_line) {
    const auto end = [](std::string_view text) {
        const auto tokens = tokenize(text);
        const size_t i = end_of_directive(tokens, 0);
        return i < tokens.size() ? std::string(tokens[i].text) : "the end";
    };
    EXPECT_EQ(end("#define A 1\nb"), "b");
    EXPECT_EQ(end("#define A \\\n 1\nb"), "b");
    EXPECT_EQ(end("#define A /*\n*/ 1\nb"), "b");
    EXPECT_EQ(end("#define A 1 // \\\n 2\nb"), "b");
    EXPECT_EQ(end("#define A"), "the end");
    EXPECT_EQ(end("#"), "the end");
}

// 1.4 MB is the largest shader we know of. Each of these would take hours in a lexer that looks at a
// character once for every token before it.
TEST(Tokens, long_texts_take_linear_time) {
    const auto repeated = [](std::string_view piece) {
        std::string text;
        while (text.size() < 1'400'000)
            text += piece;
        return text;
    };
    EXPECT_EQ(tokenize(repeated("a+")).size(), 1'400'000u);
    EXPECT_EQ(tokenize(repeated("x=1.0;// c\n")).size(), 127273u * 4);
    EXPECT_EQ(tokenize(repeated("/* ")).size(), 0u);
    EXPECT_EQ(tokenize(repeated("\\\n")).size(), 0u);
    EXPECT_EQ(tokenize("\"" + repeated("\\\"")).size(), 1'400'001u);
    EXPECT_EQ(tokenize("'" + repeated("\\'x\"")).size(), 700'001u);
    EXPECT_EQ(tokenize(repeated("9")).size(), 1u);
    EXPECT_EQ(tokenize(repeated("#")).size(), 1'400'000u);
}

} // namespace tidemark::text::tokens_test
