// A text without macros, its tree, and what the watch makes of it.
#include "glsl_support.hpp"
#include "shader/watch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace tidemark::glsl::parsed_text_test {

Result<std::unique_ptr<const ParsedText>> read(std::string_view text) {
    text::MappedText source;
    source.append(text, "a.glsl", 1);
    return ParsedText::read(std::move(source), {});
}

/// Returns the words after the preprocessor, with blanks between.
std::string expanded(std::string_view text) {
    text::MappedText source;
    source.append(text, "a.glsl", 1);
    const auto tokens = text::tokenize(source.text());
    const auto expansion = expand(tokens, preprocess(tokens, {}, true), source.lines());
    if (!expansion)
        return to_string(expansion.error());
    std::string words;
    for (const Word& word : expansion->words)
        words += (words.empty() ? "" : " ") + std::string(word.text);
    return words;
}

/// `(* (+ a b) c)`: an expression's tree.
std::string shape(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind == NodeKind::absent)
        return "-";
    if (tree[id].kind == NodeKind::parenthesis)
        return shape(text, tree.child(id, 0));
    std::string list(text.word_of(id));
    if (tree[id].first_child == k_no_node)
        return list;
    for (const NodeId child : tree.children(id))
        list += " " + shape(text, child);
    return "(" + list + ")";
}

std::string expression(std::string_view text) {
    const auto parsed = read("void f(){" + std::string(text) + ";}");
    if (!parsed)
        return to_string(parsed.error());
    const SyntaxTree& tree = (*parsed)->tree();
    const NodeId body = tree.child(tree.child(0, 0), 1);
    return shape(**parsed, tree.child(tree.child(body, 0), 0));
}

std::string error_of(std::string_view text) {
    const auto parsed = read(text);
    return parsed ? "no error" : to_string(parsed.error());
}

TEST(Expand, macros_are_expanded) {
    EXPECT_EQ(expanded("#define A 1.\n#define F(x,y) (x*y+A)\nF(2.,F(a,A))"),
              "( 2. * ( a * 1. + 1. ) + 1. )");
    EXPECT_EQ(expanded("#define F(x) x\nF (F(F)) (3)"), "F ( 3 )");
    EXPECT_EQ(expanded("#define f(x) g(x\n#define g(x) [x]\nf(1))"), "[ 1 ]");
    EXPECT_EQ(expanded("#define A B\n#define B A\nA B"), "A B");
    EXPECT_EQ(expanded("#define J(a,b) a##b\nJ(po,int) J(x,)"), "point x");
    EXPECT_EQ(expanded("#define E\n#define F() E 1\nF() E F"), "1 F");
    EXPECT_EQ(expanded("#define A 1\nA\n#undef A\nA"), "1 A");
    EXPECT_EQ(expanded("\n__LINE__"), "2");
}

TEST(Expand, adjacent_operator_characters_form_one_operator) {
    EXPECT_EQ(expanded("a+++b<<=c^^d"), "a ++ + b <<= c ^^ d");
    EXPECT_EQ(expanded("#define M -1\na-M"), "a - - 1");
}

TEST(Expand, only_code_that_is_compiled) {
    EXPECT_EQ(expanded("#if 0\na\n#elif defined(GL_X)||1\nb\n#else\nc\n#endif"), "b");
    EXPECT_EQ(expanded("#define F(x) x\n#if F(1)\na\n#endif"),
              "a.glsl:3:1: error: cannot tell whether this line is compiled");
}

TEST(Expand, refuses_unbounded_growth) {
    std::string text = "#define A0 x x\n";
    for (int i = 1; i < 60; ++i)
        text += fmt::format("#define A{0} A{1} A{1}\n", i, i - 1);
    EXPECT_NE(expanded(text + "A59").find("too long to follow"), std::string::npos);
    EXPECT_NE(expanded("#define F(x) x\nF(").find("called without an end"), std::string::npos);
}

TEST(Expand, a_token_has_the_places_of_definition_and_use) {
    const auto parsed = read("#define D(x) (x/0.)\nfloat f(float a){\n  return D(a);}\n");
    ASSERT_TRUE(parsed);
    const auto& words = (*parsed)->words();
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i].is("/")) {
            EXPECT_EQ((*parsed)->spelled(i), (SourceLocation{"a.glsl", 1, 16}));
            EXPECT_EQ((*parsed)->used(i), (SourceLocation{"a.glsl", 3, 10}));
        }
        if (words[i].is("a") && words[i - 1].is("(")) {
            EXPECT_EQ((*parsed)->spelled(i), (SourceLocation{"a.glsl", 3, 12}));
        }
    }
}

TEST(Parse, operator_precedence_follows_glsl) {
    EXPECT_EQ(expression("a+b*c-d"), "(- (+ a (* b c)) d)");
    EXPECT_EQ(expression("a=b+=c?d:e?f:g,h"), "(, (= a (+= b (? c d (? e f g)))) h)");
    EXPECT_EQ(expression("a||b&&c^^d==e<f<<g"), "(|| a (^^ (&& b c) (== d (< e (<< f g)))))");
    EXPECT_EQ(expression("-a.xy[i++]*-(b)"), "(* (- ([ (xy a) (++ i))) (- b))");
    EXPECT_EQ(expression("float[](1.,2.)[0]+f().x+v.length()"),
              "(+ (+ ([ (( ([ float -) 1. 2.) 0) (x (( f))) (( (length v)))");
}

TEST(Parse, declarations_and_expressions_are_distinguished) {
    EXPECT_EQ(error_of("struct L{vec3 p;},l[2];float f(){return l[1].p.x;}"), "no error")
        << "an empty declarator";
    EXPECT_EQ(error_of("float a,b[2]=float[2](1.,2.);const int N=3;struct S{vec3 o,d;float w[N];}s;"
                       "uniform struct{float t;}u[4];layout(location=0)out vec4 c;precision highp float;;"),
              "no error");
    EXPECT_EQ(
        error_of("float[2] g(const in float[2] x,vec2,out S s);void f(void){S a[2],b;a[0]=b;a[i]*2.;"
                 "float[3]q;for(;;){}for(int i=0,j=1;i<j;++i)if(a)b;else if(c)d;else{}do x++;while(x<3);"
                 "while(true)break;switch(n){case 1:case -2:x;default:break;}{;}return;}"),
        "no error");
}

TEST(Parse, an_error_has_its_place) {
    EXPECT_EQ(error_of("void f(){\n  a = * 2;\n}"), "a.glsl:2:7: error: expected an expression at '*'");
    EXPECT_EQ(error_of("void f(){ if (a) "),
              "a.glsl:1:16: error: expected an expression at the end of the text");
    EXPECT_EQ(error_of("int 3;"), "a.glsl:1:5: error: expected ';' at '3'");
}

TEST(Parse, too_deep_nesting_is_refused) {
    for (const std::string_view open : {"(", "-", "f(", "a[", "a?b:", "a=", "{", "if(a)", "if(a);else "}) {
        std::string text = "void f(){";
        for (int i = 0; i < 100'000; ++i)
            text += open;
        EXPECT_NE(error_of(text).find("too deeply"), std::string::npos) << open;
    }
    std::string sum = "float x=a";
    for (int i = 0; i < 100'000; ++i)
        sum += "+a";
    EXPECT_NE(error_of(sum + ";").find("too deeply"), std::string::npos);
}

/// Returns the instrumented text, without the generated functions before it.
std::string watched(std::string_view text, WatchRequest request = {}) {
    const auto parsed = read(text);
    EXPECT_TRUE(parsed);
    request.reach = WatchRequest::Reach::everything;
    std::string all = watch(**parsed, find_facts(**parsed), request).text;
    const size_t end = all.rfind("bvec4 tmw0_P");
    all = all.substr(all.find('\n', end) + 1);
    all = all.substr(0, all.rfind("\nvoid main"));
    for (size_t at = 0; (at = all.find_first_of(" \n", at)) != all.npos;)
        all.erase(at, 1);
    for (size_t at = 0; (at = all.find(',', at)) != all.npos; ++at) // the numbers of nodes say nothing
        while (at + 1 < all.size() && all[at + 1] >= '0' && all[at + 1] <= '9')
            all.erase(at + 1, 1);
    return all;
}

TEST(Watch, operations_that_can_create_nan_are_wrapped) {
    EXPECT_EQ(watched("void f(){x=a/b;y=-a;z=sin(a);w=vec2(a,b);}"),
              "voidf(){x=tmw0_P(a/b,);y=-a;z=tmw0_P(sin(a),);w=vec2(a,b);}");
    EXPECT_EQ(watched("void f(){x*=a;v[i++]/=a;}"), "voidf(){(x*=a,tmw0_P(x,));v[i++]/=a;}");
}

TEST(Watch, constant_expressions_and_lvalues_are_unchanged) {
    EXPECT_EQ(watched("const float a=1./2.;uniform float u;"), "constfloata=1./2.;uniformfloatu;");
    EXPECT_EQ(watched("void g(out float x);void f(int n){int i=n*2;g(a[n+1]);float q[2*3];}"),
              "voidg(outfloatx);voidf(intn){inti=n*2;g(a[n+1]);floatq[2*3];}");
    EXPECT_EQ(watched("float f(){return b&&c/d>1.?e*2.:g;}"),
              "floatf(){returnb&&tmw0_P(c/d,)>1.?tmw0_P(e*2.,):g;}");
}

} // namespace tidemark::glsl::parsed_text_test
