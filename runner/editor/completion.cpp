// Completion.

#include "base/encoding.hpp"
#include "editor/session.hpp"
#include "editor/workspace.hpp"
#include "scene/channel.hpp"
#include "scene/host_uniforms.hpp"
#include "scene/knob.hpp"
#include "scene/names.hpp"
#include "shader/builtin_functions.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <utility>

namespace tidemark::lsp {
namespace fs = std::filesystem;
namespace {

using text::Token;
using text::TokenKind;

/// The protocol's CompletionItemKind.
enum class ItemKind {
    function = 3,
    field = 5,
    variable = 6,
    property = 10,
    value = 12,
    keyword = 14,
    file = 17,
    folder = 19,
    constant = 21,
    structure = 22,
    type = 25,
};

constexpr size_t k_most_entries = 2000; ///< of a folder
constexpr int k_deepest_expression = 100;

/// The items of one answer, each label once.
class Items {
public:
    void add(std::string label, ItemKind kind, std::string detail = {}, std::string about = {}) {
        if (label.empty() || !labels_.insert(label).second)
            return;
        Json item{{"label", std::move(label)}, {"kind", int(kind)}};
        if (!detail.empty())
            item["detail"] = std::move(detail);
        if (!about.empty())
            item["documentation"] = {{"kind", "markdown"}, {"value", std::move(about)}};
        items_.push_back(std::move(item));
    }
    /// Replaces `range` by the label, for labels that are not one word.
    void replace(const Json& range) {
        for (Json& item : items_)
            item["textEdit"] = {{"range", range}, {"newText", item["label"]}};
    }
    Json take() { return Json{{"isIncomplete", false}, {"items", std::move(items_)}}; }

private:
    std::set<std::string> labels_;
    Json items_ = Json::array();
};

/// The types of expressions, as far as tokens determine them.
class Types {
public:
    Types(const Workspace& workspace, const FileNames& names, size_t offset)
        : workspace_(workspace), names_(names), offset_(offset) {
        for (const size_t file : workspace.files_beside(0)) {
            if (file == 0)
                continue;
            others_.push_back(std::make_unique<FileNames>(workspace.files[file].text));
        }
    }

    struct Type {
        std::string name; ///< empty: unknown
        bool array = false;
    };

    /// Returns the type of the expression that ends with the token: a name, a member, a call or an index.
    Type ending_at(size_t token, int depth = 0) const {
        const auto& tokens = names_.tokens();
        if (token >= tokens.size() || depth > k_deepest_expression)
            return {};
        if (tokens[token].is("]")) {
            const size_t open = opening(token);
            return open == 0 ? Type{} : element(ending_at(open - 1, depth + 1));
        }
        if (tokens[token].is(")")) {
            const size_t open = opening(token);
            if (open > 0 && tokens[open - 1].kind == TokenKind::identifier &&
                !glsl::is_keyword(tokens[open - 1].text))
                return called(open - 1, open, token, depth);
            return open < token ? of_range(open + 1, token, depth + 1) : Type{};
        }
        if (tokens[token].kind == TokenKind::number) {
            const auto type = glsl::type_of_literal(tokens[token].text);
            return type ? Type{glsl::to_string(*type)} : Type{};
        }
        if (tokens[token].kind != TokenKind::identifier)
            return {};
        if (token > 1 && tokens[token - 1].is("."))
            return member(ending_at(token - 2, depth + 1), tokens[token].text);
        return variable(tokens[token].text);
    }

    /// Returns the members of a structure.
    std::vector<const Member*> members_of(std::string_view structure) const {
        std::vector<const Member*> found;
        const auto add = [&](const FileNames& names) {
            for (const Member& each : names.members())
                if (each.structure == structure)
                    found.push_back(&each);
        };
        add(names_);
        for (const auto& other : others_)
            add(*other);
        return found;
    }

private:
    /// Returns the token that opens the bracket closed at `close`; 0 if none does.
    size_t opening(size_t close) const {
        int depth = 0;
        for (size_t i = close + 1; i-- > 0;) {
            depth -= glsl::nesting(names_.tokens()[i].text);
            if (depth == 0)
                return i;
            if (names_.tokens()[i].is(";"))
                return 0;
        }
        return 0;
    }

    static Type element(const Type& type) {
        if (type.array)
            return {type.name};
        auto value = glsl::value_type(type.name);
        if (!value || value->scalar())
            return {};
        if (value->matrix())
            value->columns = 1;
        else
            value->rows = 1;
        return {glsl::to_string(*value)};
    }

    Type member(const Type& type, std::string_view name) const {
        if (const auto value = glsl::value_type(type.name); value && !type.array) {
            const auto result = glsl::type_of_member(*value, name);
            return result ? Type{glsl::to_string(*result)} : Type{};
        }
        for (const Member* each : members_of(type.name))
            if (each->name == name)
                return {std::string(each->type), each->array};
        return {};
    }

    Type variable(std::string_view name) const {
        if (const Local* local = names_.local(name, offset_))
            return {std::string(local->type), local->array};
        if (const scene::Knob* knob = workspace_.knob(name))
            return {std::string(info(knob->type).glsl_name)};
        for (const size_t file : workspace_.files_beside(0))
            for (const Symbol& symbol : workspace_.files[file].symbols)
                if (symbol.name == name &&
                    (symbol.kind == Symbol::Kind::variable || symbol.kind == Symbol::Kind::constant))
                    return declared(symbol);
        if (const scene::HostUniform* row = scene::find_host_uniform(name))
            return {std::string(row->type), row->length > 0};
        return {name == "gl_FragCoord" || name == "gl_FragColor" ? "vec4" : ""};
    }

    /// Returns the type that begins a declaration: `const vec3 a[2]`.
    static Type declared(const Symbol& symbol) {
        const auto tokens = text::tokenize(symbol.signature);
        size_t i = 0;
        while (i < tokens.size() && glsl::is_keyword(tokens[i].text))
            ++i;
        if (i >= tokens.size())
            return {};
        const auto name = std::ranges::find(tokens, std::string_view(symbol.name), &Token::text);
        const bool array = (i + 1 < tokens.size() && tokens[i + 1].is("[")) ||
                           (name != tokens.end() && name + 1 != tokens.end() && (name + 1)->is("["));
        return {std::string(tokens[i].text), array};
    }

    Type called(size_t callee, size_t open, size_t close, int depth) const {
        const std::string_view name = names_.tokens()[callee].text;
        if (glsl::value_type(name) || !members_of(name).empty())
            return {std::string(name)};
        for (const size_t file : workspace_.files_beside(0))
            for (const Symbol& symbol : workspace_.files[file].symbols)
                if (symbol.name == name && symbol.kind == Symbol::Kind::function)
                    return declared(symbol);
        const glsl::BuiltinFunction* const function = glsl::find_builtin(name);
        if (!function)
            return {};
        const auto overloads = glsl::overloads_of(*function);
        if (std::ranges::all_of(overloads,
                                [&](const auto& each) { return each.result == overloads[0].result; }))
            return {std::string(overloads[0].result)};
        std::vector<glsl::ValueType> arguments;
        size_t begin = open + 1;
        int nesting = 0;
        for (size_t i = open + 1; i <= close; ++i) {
            nesting += i < close ? glsl::nesting(names_.tokens()[i].text) : 0;
            if (nesting != 0 || (i < close && !names_.tokens()[i].is(",")))
                continue;
            const auto type = glsl::value_type(of_range(begin, i, depth + 1).name);
            if (type)
                arguments.push_back(*type);
            begin = i + 1;
        }
        const auto type = glsl::type_of_call(*function, arguments);
        return type ? Type{glsl::to_string(*type)} : Type{};
    }

    /// Returns the type of an expression with binary operators: that of its largest operand.
    Type of_range(size_t begin, size_t end, int depth) const {
        if (depth > k_deepest_expression)
            return {};
        Type largest;
        size_t most = 0;
        int nesting = 0;
        for (size_t i = begin; i < end; ++i) {
            nesting += glsl::nesting(names_.tokens()[i].text);
            if (nesting != 0 || (i + 1 < end && !is_operator(names_.tokens()[i + 1])))
                continue;
            const Type type = ending_at(i, depth + 1);
            const auto value = glsl::value_type(type.name);
            const size_t size = value ? size_t(value->columns * value->rows) : type.name.empty() ? 0 : 100;
            if (size > most) {
                largest = type;
                most = size;
            }
        }
        return largest;
    }

    static bool is_operator(const Token& token) {
        return token.kind == TokenKind::punctuation && token.text.find_first_of("+-*/%,?:<>=&|^") == 0;
    }

    const Workspace& workspace_;
    const FileNames& names_;
    size_t offset_;
    std::vector<std::unique_ptr<FileNames>> others_;
};

/// Adds the files and folders that a path typed so far may mean: those beside `folder`.
void add_files(Items& items, const fs::path& folder, std::string_view typed, const auto& wanted) {
    const size_t slash = typed.rfind('/');
    const fs::path inside = slash == typed.npos ? fs::path() : fs::path(typed.substr(0, slash));
    if (inside.is_absolute())
        return;
    std::error_code error;
    size_t seen = 0;
    for (fs::directory_iterator entry(folder / inside, error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (++seen > k_most_entries || name.starts_with('.'))
            continue;
        std::error_code ignored;
        const std::string label = (inside / name).generic_string();
        if (entry->is_directory(ignored))
            items.add(label + "/", ItemKind::folder);
        else if (wanted(entry->path()))
            items.add(label, ItemKind::file);
    }
}

bool is_media_file(const fs::path& file) {
    constexpr std::string_view k_endings[] = {".png",  ".jpg", ".jpeg", ".webp", ".exr", ".hdr",  ".tif",
                                              ".tiff", ".bmp", ".gif",  ".bin",  ".mp3", ".ogg",  ".wav",
                                              ".flac", ".mp4", ".webm", ".mov",  ".mkv", ".glsl", ".frag"};
    const std::string ending = lower_case(file.extension().string());
    return std::ranges::find(k_endings, ending) != std::end(k_endings);
}

struct Directive {
    std::string_view name;
    std::string_view about;
};
constexpr Directive k_directives[] = {
    {"iChannel0", "input of iChannel0: `#iChannel0 \"file or pass\"`"},
    {"iChannel1", "input of iChannel1: `#iChannel1 \"file or pass\"`"},
    {"iChannel2", "input of iChannel2: `#iChannel2 \"file or pass\"`"},
    {"iChannel3", "input of iChannel3: `#iChannel3 \"file or pass\"`"},
    {"iUniform", "a knob: `#iUniform float speed = 1.0 in { 0.0, 2.0 }`"},
    {"iSize", "size of the picture: `#iSize 800x450`"},
    {"iKeyboard", "declares isKeyDown(Key_A) and the like"},
    {"iFirstPersonControls", "mouse and wheel move iViewMatrix"},
    {"include", "pastes a file: `#include \"file.glsl\"`"},
    {"define", "a macro"},
    {"undef", "ends a macro"},
    {"if", "compiles the lines up to #endif if the expression is not 0"},
    {"ifdef", "compiles the lines up to #endif if the macro is defined"},
    {"ifndef", "compiles the lines up to #endif if the macro is not defined"},
    {"else", "the other lines of an #if"},
    {"elif", "another condition of an #if"},
    {"endif", "ends an #if"},
    {"extension", "turns on an extension of GLSL"},
};

struct Parameter {
    std::string_view name;
    std::vector<std::string_view> values;
};
const std::vector<Parameter>& channel_parameters() {
    static const std::vector<Parameter> parameters{
        {"MinFilter",
         {"Nearest", "Linear", "NearestMipMapNearest", "NearestMipMapLinear", "LinearMipMapNearest",
          "LinearMipMapLinear"}},
        {"MagFilter", {"Nearest", "Linear"}},
        {"WrapMode", {"Repeat", "Clamp", "Mirror"}},
        {"VFlip", {"true", "false"}},
        {"Type", {"Texture2D", "CubeMap"}}};
    return parameters;
}

/// The knob types of `#iUniform`.
constexpr std::string_view k_knob_types[] = {"float", "vec2",  "vec3",  "vec4", "color3",
                                             "int",   "ivec2", "ivec3", "ivec4"};

/// Completes a line that begins with `#`, up to the cursor.
class DirectiveCompletion {
public:
    DirectiveCompletion(const Question& asked, std::string_view line, size_t offset)
        : asked_(asked), file_(asked.workspace.files.front()), line_(line), offset_(offset) {}

    /// Returns nothing if the line is completed like code: the body of a macro.
    std::optional<Json> run() {
        std::string_view rest = line_.substr(line_.find('#') + 1);
        rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
        const size_t end = std::min(rest.find_first_of(" \t\"<:("), rest.size());
        const std::string_view keyword = rest.substr(0, end);
        if (end == rest.size()) {
            for (const Directive& each : k_directives)
                items_.add(std::string(each.name), ItemKind::keyword, {}, std::string(each.about));
            return finish(keyword.size());
        }
        rest.remove_prefix(end);
        if (keyword == "include")
            return include(rest);
        if (keyword.starts_with("iChannel"))
            return rest.starts_with(':') ? parameter(rest) : channel(rest);
        if (keyword == "iUniform")
            return knob(rest);
        if (keyword != "iSize")
            return std::nullopt;
        for (const char* size : {"800x450", "640x360", "1280x720", "1920x1080", "1024x1024"})
            items_.add(size, ItemKind::value);
        return finish(trimmed(rest).size());
    }

private:
    /// Returns the items, which replace the last `typed` bytes before the cursor.
    Json finish(size_t typed) {
        items_.replace(Lines(file_.text, asked_.encoding).range(offset_ - typed, offset_));
        return items_.take();
    }

    /// Returns the text after an open quote; nothing if no quote is open.
    static std::optional<std::string_view> quoted(std::string_view rest, char quote) {
        const size_t open = rest.find(quote);
        if (open == rest.npos || rest.find(quote == '<' ? '>' : quote, open + 1) != rest.npos)
            return std::nullopt;
        return rest.substr(open + 1);
    }

    Json include(std::string_view rest) {
        constexpr std::string_view k_library = "tidemark/";
        if (const auto typed = quoted(rest, '"')) {
            add_files(items_, file_.path.parent_path(), *typed, [&](const fs::path& file) {
                return scene::is_shader_file(file) && canonical_name(file) != file_.path;
            });
            return finish(typed->size());
        }
        const auto typed = quoted(rest, '<');
        if (!typed)
            return Json();
        std::error_code error;
        for (fs::directory_iterator entry(asked_.workspace.library, error), end; !error && entry != end;
             entry.increment(error))
            if (scene::is_shader_file(entry->path()))
                items_.add(std::string(k_library) + entry->path().filename().string(), ItemKind::file, {},
                           leading_comment(asked_.documents.text_of(entry->path()).value_or("")));
        return finish(typed->size());
    }

    Json channel(std::string_view rest) {
        const auto typed = quoted(rest, '"');
        if (!typed)
            return Json();
        for (const scene::InputTraits& traits : scene::k_input_traits)
            if (traits.by_name)
                items_.add(std::string(traits.name), ItemKind::value);
        add_files(items_, file_.path.parent_path(), *typed, is_media_file);
        return finish(typed->size());
    }

    Json parameter(std::string_view rest) {
        rest.remove_prefix(std::min(rest.find_first_not_of(":"), rest.size()));
        const auto typed = quoted(rest, '"');
        if (!typed) {
            for (const Parameter& each : channel_parameters())
                items_.add(std::string(each.name), ItemKind::property);
            return finish(trimmed(rest).size());
        }
        for (const Parameter& each : channel_parameters())
            if (rest.starts_with(each.name))
                for (const std::string_view value : each.values)
                    items_.add(std::string(value), ItemKind::value);
        return finish(typed->size());
    }

    Json knob(std::string_view rest) {
        rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
        const size_t type = rest.find_first_of(" \t");
        if (type == rest.npos) {
            for (const std::string_view each : k_knob_types)
                items_.add(std::string(each), ItemKind::type);
            return finish(rest.size());
        }
        const size_t word = rest.find_last_of(" \t") + 1;
        if (rest.find('=') == rest.npos)
            return Json();
        items_.add("in", ItemKind::keyword, "in { LOW, HIGH }", "the range of the slider");
        items_.add("step", ItemKind::keyword, "step SIZE", "the step of the slider");
        return finish(rest.size() - word);
    }

    const Question& asked_;
    const SourceFile& file_;
    std::string_view line_;
    size_t offset_;
    Items items_;
};

constexpr std::string_view k_component_names[] = {"xyzw", "rgba"};

void add_members(Items& items, const Types& types, const Types::Type& type) {
    if (type.array) {
        items.add("length()", ItemKind::function, "int length()");
        return;
    }
    for (const Member* each : types.members_of(type.name))
        items.add(std::string(each->name), ItemKind::field,
                  fmt::format("{} {}{}", each->type, each->name, each->array ? "[]" : ""));
    const auto value = glsl::value_type(type.name);
    if (!value || !value->vector())
        return;
    for (const std::string_view names : k_component_names) {
        const std::string_view all = names.substr(0, size_t(value->rows));
        for (size_t size = 1; size <= all.size(); ++size)
            for (size_t begin = 0; begin + size <= all.size(); ++begin) {
                const std::string_view swizzle = all.substr(begin, size);
                const auto result = glsl::type_of_member(*value, swizzle);
                items.add(std::string(swizzle), ItemKind::field,
                          fmt::format("{} {}", result ? glsl::to_string(*result) : "", swizzle));
            }
        if (value->rows >= 3)
            items.add(std::string{names[0], names[2]}, ItemKind::field,
                      fmt::format("{} {}{}", value->base == 'f' ? "vec2" : fmt::format("{}vec2", value->base),
                                  names[0], names[2]));
    }
}

ItemKind item_kind(Symbol::Kind kind) {
    switch (kind) {
    case Symbol::Kind::function: return ItemKind::function;
    case Symbol::Kind::variable: return ItemKind::variable;
    case Symbol::Kind::constant: return ItemKind::constant;
    case Symbol::Kind::structure: return ItemKind::structure;
    case Symbol::Kind::macro: return ItemKind::constant;
    case Symbol::Kind::knob: return ItemKind::property;
    }
    return ItemKind::variable;
}

/// Adds everything that code may name at the offset.
void add_names(Items& items, const Workspace& workspace, const FileNames& names, size_t offset) {
    std::vector<const Local*> locals;
    for (const Local& local : names.locals())
        if (local.begin <= offset && offset < local.end)
            locals.push_back(&local);
    std::ranges::sort(locals, std::greater(), &Local::begin); // an inner one hides an outer one
    for (const Local* local : locals)
        items.add(std::string(local->name), ItemKind::variable,
                  fmt::format("{} {}", local->type, local->name));
    for (const size_t file : workspace.files_beside(0))
        for (const Symbol& symbol : workspace.files[file].symbols)
            items.add(symbol.name, item_kind(symbol.kind), symbol.signature, symbol.comment);
    for (const scene::Knob& knob : workspace.knobs)
        items.add(knob.name, ItemKind::property, fmt::format("{} {}", info(knob.type).glsl_name, knob.name));
    for (const scene::HostUniform& row : scene::k_host_uniforms)
        items.add(
            std::string(row.name), ItemKind::variable,
            fmt::format("{} {}{}", row.type, row.name, row.length > 0 ? fmt::format("[{}]", row.length) : ""),
            std::string(row.meaning));
    for (const std::string_view channel : scene::k_channel_names)
        items.add(std::string(channel), ItemKind::variable, "input of the pass");
    for (const glsl::BuiltinFunction& function : glsl::builtin_functions()) {
        const auto overloads = glsl::overloads_of(function);
        items.add(std::string(function.name), ItemKind::function,
                  overloads.empty() ? "" : signature(function, overloads.front()));
    }
    for (const std::string_view type : glsl::k_vectors)
        items.add(std::string(type), ItemKind::type);
    for (const std::string_view type : glsl::k_matrices)
        items.add(std::string(type), ItemKind::type);
    for (const std::string_view keyword : glsl::k_keywords)
        items.add(std::string(keyword), ItemKind::keyword);
    if (locals.empty())
        items.add("mainImage", ItemKind::function, "void mainImage(out vec4 fragColor, in vec2 fragCoord)",
                  "called by the host for each pixel");
}

/// Returns the index of the first token that does not end before the offset.
size_t token_at(const std::vector<Token>& tokens, size_t offset) {
    return size_t(
        std::ranges::lower_bound(tokens, offset, {}, [](const Token& token) { return token.end(); }) -
        tokens.begin());
}

} // namespace

/// Returns a CompletionList for the cursor; null in a comment.
Answer completions(const Question& asked) {
    const SourceFile& file = asked.workspace.files.front();
    const size_t offset = asked.offset();
    const std::string_view before = std::string_view(file.text).substr(0, offset);
    if (ends_in_comment(before))
        return Json();
    const std::string_view line = before.substr(before.rfind('\n') + 1);
    if (trimmed(line).starts_with('#'))
        if (auto found = DirectiveCompletion(asked, line, offset).run())
            return *std::move(found);
    const std::string text = with_closed_brackets(file.text, before);
    const FileNames names(text);
    const auto& tokens = names.tokens();
    const size_t token = token_at(tokens, offset);
    const bool touches = token < tokens.size() && tokens[token].begin < offset;
    if (touches && tokens[token].kind == TokenKind::number)
        return Json(); // `1.` is a number and has no members
    const bool in_word = touches && tokens[token].kind == TokenKind::identifier;
    const size_t next = touches && !in_word ? token + 1 : token; // the word that is typed
    const bool after_dot = next > 0 && tokens[next - 1].is(".");
    Items items;
    if (after_dot) {
        const Types types(asked.workspace, names, offset);
        add_members(items, types, next > 1 ? types.ending_at(next - 2) : Types::Type{});
    } else {
        add_names(items, asked.workspace, names, offset);
    }
    return items.take();
}

Json resolved_completion(Json item) {
    const auto label = item.at("label").get<std::string>();
    if (item.contains("documentation"))
        return item;
    std::string about = describe_builtin(label);
    if (about.empty() && (scene::is_host_uniform(label)))
        about = describe_host(label);
    if (!about.empty() && item.value("kind", 0) != int(ItemKind::field))
        item["documentation"] = {{"kind", "markdown"}, {"value", about}};
    return item;
}

} // namespace tidemark::lsp
