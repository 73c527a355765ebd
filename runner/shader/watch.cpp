// Finds every path of calls from main to an operation, and the loops along those paths.

#include "shader/watch.hpp"

#include "shader/source_edits.hpp"
#include "shader/tree_facts.hpp"
#include "shader/undefined_behaviour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tidemark::glsl {

struct CallPaths {
    std::vector<NodeId> calls; ///< calls of functions that lead to the operation, ascending; functions that
                               ///< return arrays are left out
    std::vector<NodeId> loops; ///< loops around the operation or around one of those calls
};

// Writes the GLSL functions that a watched text calls: one overload per type.

/// The functions to write.
struct PreludeOptions {
    std::string prefix; ///< prefix of every name
    bool capture = false;
    bool repair = false;
    bool nan_only = false;
    bool doubles = false; ///< the GLSL version has doubles
    size_t loops = 0;     ///< number of loop counters
};

namespace {

std::string_view function_around(const ParsedText& text, NodeId id) {
    const NodeId function = text.tree().around(id, NodeKind::function);
    return function == k_no_node ? std::string_view{} : text.word_of(function);
}

void add_loops_around(const ParsedText& text, NodeId id, std::vector<NodeId>& loops) {
    const SyntaxTree& tree = text.tree();
    for (NodeId around = id; around != k_no_node; around = tree[around].parent)
        if (is_loop(tree[around].kind) && std::find(loops.begin(), loops.end(), around) == loops.end())
            loops.push_back(around);
}

} // namespace

CallPaths find_call_paths(const ParsedText& text, const TreeFacts& facts, NodeId operation) {
    const SyntaxTree& tree = text.tree();
    std::unordered_map<std::string_view, std::vector<NodeId>> calls_of;
    for (NodeId id = 1; id < tree.nodes.size(); ++id)
        if (tree[id].kind == NodeKind::call)
            if (const auto* function = facts.function(called_name(text, id));
                function && !function->returns_array)
                calls_of[called_name(text, id)].push_back(id);
    CallPaths reach;
    add_loops_around(text, operation, reach.loops);
    std::vector<std::string_view> open{function_around(text, operation)};
    std::unordered_set<std::string_view> seen(open.begin(), open.end());
    while (!open.empty()) {
        const std::string_view name = open.back();
        open.pop_back();
        for (const NodeId call : calls_of[name]) {
            reach.calls.push_back(call);
            add_loops_around(text, call, reach.loops);
            if (const auto caller = function_around(text, call); seen.insert(caller).second)
                open.push_back(caller);
        }
    }
    std::sort(reach.calls.begin(), reach.calls.end());
    return reach;
}

namespace {

constexpr std::array<std::string_view, 4> k_doubles{"double", "dvec2", "dvec3", "dvec4"};

constexpr std::string_view k_any_bad =
    R"(bool $bad(float v){return (floatBitsToUint(v)&0x7f800000u)==0x7f800000u;}
)";
constexpr std::string_view k_nan_bad =
    R"(bool $bad(float v){return (floatBitsToUint(v)&0x7fffffffu)>0x7f800000u;}
)";
constexpr std::string_view k_bad_vectors = R"(bool $bad(vec2 v){return $bad(v.x)||$bad(v.y);}
bool $bad(vec3 v){return $bad(v.x)||$bad(v.y)||$bad(v.z);}
bool $bad(vec4 v){return $bad(v.x)||$bad(v.y)||$bad(v.z)||$bad(v.w);}
float $mend(float v){return $bad(v)?0.5:v;}
vec2 $mend(vec2 v){return vec2($mend(v.x),$mend(v.y));}
vec3 $mend(vec3 v){return vec3($mend(v.x),$mend(v.y),$mend(v.z));}
vec4 $mend(vec4 v){return vec4($mend(v.xy),$mend(v.zw));}
)";

/// Without operands to record, a hit is one assignment: the driver has no branch to follow.
constexpr std::string_view k_probe = "@ $P(@ v,int i){$h=$h==0&&$bad(v)?i:$h;return v;}\n";
constexpr std::string_view k_recording_probe =
    "@ $P(@ v,int i){if($h==0&&$bad(v)){$h=i;$store(2,v);$leave();}return v;}\n";
constexpr std::string_view k_no_probe = "@ $P(@ v,int i){return v;}\n";
constexpr std::string_view k_repair = "@ $R(@ v){return $mend(v);}\n";
constexpr std::string_view k_no_repair = "@ $R(@ v){return v;}\n";
constexpr std::string_view k_capture = "@ $C(@ v,int k){if($h==0)$store(k,v);return v;}\n";
constexpr std::string_view k_pop = "@ $K(int n,@ v){--$depth;return v;}\n";

/// Returns the function that stores a value of `type` in a slot: its code, then its numbers as bits.
std::string store(std::string_view prefix, std::string_view type, int code, int components) {
    constexpr std::string_view k_letters = "xyzw";
    const std::string_view to_bits = type == "float" || type.starts_with("vec") ? "floatBitsToUint" : "uint";
    std::string text = fmt::format("void {0}store(int k,{1} v){{{0}out[k]={2}u;", prefix, type, code);
    for (int i = 0; i < components; ++i)
        text += fmt::format("{}out[k+{}]={}(v{});", prefix, i + 1, to_bits,
                            components == 1 ? std::string() : fmt::format(".{}", k_letters[size_t(i)]));
    return text + "}\n";
}

std::string store_matrix(std::string_view prefix, int columns, int rows) {
    std::string text = fmt::format("void {0}store(int k,mat{1}x{2} v){{{0}out[k]={3}u;", prefix, columns,
                                   rows, k_matrix_slot + 10 * columns + rows);
    for (int i = 0; i < columns * rows; ++i)
        text += fmt::format("{}out[k+{}]=floatBitsToUint(v[{}][{}]);", prefix, i + 1, i / rows, i % rows);
    return text + "}\n";
}

std::string matrix_functions(std::string_view prefix, int columns, int rows) {
    std::string bad;
    std::string mended;
    for (int i = 0; i < columns; ++i) {
        bad += fmt::format("{}{}bad(v[{}])", i > 0 ? "||" : "", prefix, i);
        mended += fmt::format("{}{}mend(v[{}])", i > 0 ? "," : "", prefix, i);
    }
    return fmt::format("bool {0}bad(mat{1}x{2} v){{return {3};}}\nmat{1}x{2} {0}mend(mat{1}x{2} v){{return "
                       "mat{1}x{2}({4});}}\n",
                       prefix, columns, rows, bad, mended);
}

class Prelude {
public:
    explicit Prelude(const PreludeOptions& options) : options_(options) {}

    std::string run() {
        add("layout(std430,binding=0) buffer $Buffer{uint $out[];};\nint $h=0;\n", {});
        if (options_.repair)
            add("int $iterations=0;\n", {});
        add(options_.nan_only ? k_nan_bad : k_any_bad, {});
        add(k_bad_vectors, {});
        for_each_matrix([&](int c, int r) { text_ += matrix_functions(options_.prefix, c, r); });
        if (options_.capture)
            add_records();
        for (const auto type : k_float_vectors)
            add_type(type, true);
        for_each_matrix([&](int c, int r) { add_type(fmt::format("mat{}x{}", c, r), true); });
        for (const auto type : k_whole_vectors)
            add_type(type, false);
        if (options_.doubles)
            for (const auto type : k_doubles)
                add_type(type, false);
        return std::move(text_);
    }

private:
    void add(std::string_view pattern, std::string_view type) {
        text_ += spell(pattern, options_.prefix, type);
    }

    template <class F>
    static void for_each_matrix(F&& use) {
        for (int columns = 2; columns <= 4; ++columns)
            for (int rows = 2; rows <= 4; ++rows)
                use(columns, rows);
    }

    void add_records() {
        add("int $depth=0;\n", {});
        for (size_t i = 0; i < options_.loops; ++i)
            text_ += fmt::format("int {}L{}=0;\n", options_.prefix, i);
        add(fmt::format("int $push(int site){{if($h==0&&$depth<{})$out[{}+$depth]=uint(site);return "
                        "$depth++;}}\nvoid $pop(){{--$depth;}}\n",
                        WatchLayout::k_most_calls, WatchLayout::k_path),
            {});
        text_ += spell(fmt::format("void $leave(){{$out[{}]=uint($depth);", WatchLayout::k_depth),
                       options_.prefix, {});
        for (size_t i = 0; i < options_.loops; ++i)
            text_ +=
                spell(fmt::format("$out[{}]=uint($L{});", WatchLayout::k_loops + i, i), options_.prefix, {});
        text_ += "}\n";
        for (size_t i = 0; i < std::size(k_vectors); ++i)
            text_ += store(options_.prefix, k_vectors[i], int(i) + 1, int(i % 4) + 1);
        for_each_matrix([&](int c, int r) { text_ += store_matrix(options_.prefix, c, r); });
    }

    void add_type(std::string_view type, bool floating) {
        const bool is_double = type[0] == 'd';
        add(!floating ? k_no_probe : options_.capture ? k_recording_probe : k_probe, type);
        if (options_.repair)
            add(floating ? k_repair : k_no_repair, type);
        if (options_.capture) {
            add(is_double ? "@ $C(@ v,int k){return v;}\n" : k_capture, type);
            add(k_pop, type);
        }
    }

    const PreludeOptions& options_;
    std::string text_;
};

} // namespace

/// Returns the functions to put before the text.
std::string watch_prelude(const PreludeOptions& options) {
    return Prelude(options).run();
}

/// Returns the overloads for a structure, to put after its definition.
std::string structure_overloads(const PreludeOptions& options, const TreeFacts& facts,
                                std::string_view name) {
    std::string bad;
    for (const StructureMember& member : facts.structures.at(name))
        if (!member.array && (class_of_type(member.type) == TypeClass::floating ||
                              (facts.structures.contains(member.type) && member.type != name)))
            bad += fmt::format("||{}bad(v.{})", options.prefix, member.name);
    std::string text = spell(fmt::format("bool $bad(@ v){{return false{};}}\n", bad), options.prefix, name);
    text +=
        spell(options.capture ? "@ $P(@ v,int i){if($h==0&&$bad(v)){$h=i;$leave();}return v;}\n" : k_probe,
              options.prefix, name);
    if (options.repair)
        text += spell(k_no_repair, options.prefix, name);
    if (options.capture)
        text += spell(k_pop, options.prefix, name);
    return text;
}

std::optional<ValueType> slot_type(unsigned code) {
    if (code >= k_matrix_slot + 22 && code <= k_matrix_slot + 44)
        return ValueType{'f', int(code - k_matrix_slot) / 10, int(code - k_matrix_slot) % 10};
    return code >= 1 && code <= std::size(k_vectors) ? value_type(k_vectors[code - 1]) : std::nullopt;
}

namespace {

bool contains(const std::vector<NodeId>& ids, NodeId id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

/// Limit of the iterations of all loops of a pixel with repaired values: a loop that a NaN or an infinity
/// ended may not end without it, and not every driver stops it.
constexpr int k_most_iterations = 1'000'000;

class Watcher {
public:
    Watcher(const ParsedText& text, const TreeFacts& facts, const WatchRequest& request)
        : text_(text), tree_(text.tree()), facts_(facts), request_(request), prefix_(fresh_prefix(text)),
          edits_(text) {
        if (request.capture != k_no_node) {
            result_.operands = operands_of(request.capture);
            call_paths_ = find_call_paths(text, facts, request.capture);
            result_.loops = call_paths_.loops;
            result_.loops.resize(std::min(result_.loops.size(), WatchLayout::k_most_loops));
        }
        options_ = {prefix_,
                    request.capture != k_no_node,
                    !request.repaired.empty(),
                    request.nan_only,
                    text.headers().find("#version 450") != std::string::npos,
                    result_.loops.size()};
    }

    Watch run() {
        for (const NodeId part : tree_.children(0))
            global(part);
        result_.text = headers_with_buffers(text_) + watch_prelude(options_) + edits_.text() +
                       fmt::format("\nvoid main(){{{}main();{}}}\n", prefix_, flush());
        return std::move(result_);
    }

private:
    /// Whether an enclosing expression is already watched.
    enum class Cover { open, covered };

    std::string ours(std::string_view name) const { return prefix_ + std::string(name); }

    std::string flush() const {
        if (request_.map_width > 0)
            return fmt::format("{0}out[int(gl_FragCoord.x)+{1}*int(gl_FragCoord.y)]=uint({0}h);", prefix_,
                               request_.map_width);
        return fmt::format("{0}out[{1}]=1u;{0}out[{2}]=uint({0}h);", prefix_, WatchLayout::k_arrived,
                           WatchLayout::k_hit);
    }

    // Declarations.

    void global(NodeId id) {
        if (tree_[id].kind == NodeKind::function && text_.word_of(id) == "main")
            edits_.replace(tree_[id].word, ours("main"));
        visit(id, Cover::open);
        for (const NodeId child : tree_.children(id))
            if (tree_[child].kind == NodeKind::type && tree_[id].kind != NodeKind::function)
                structure_functions(id, child);
    }

    void structure_functions(NodeId declaration, NodeId type) {
        const std::string_view name = type_name(text_, type);
        const auto structure = facts_.structures.find(name);
        if (tree_.child(type, 0) == k_no_node || structure == facts_.structures.end())
            return;
        for (const StructureMember& member : structure->second)
            if (class_of_type(member.type) == TypeClass::sampler)
                return;
        edits_.wrap(declaration, "", "\n" + structure_overloads(options_, facts_, name));
    }

    // Everything else. Inner nodes are wrapped before outer ones.

    void children(NodeId id, Cover cover) {
        for (const NodeId child : tree_.children(id))
            visit(child, cover);
    }

    void visit(NodeId id, Cover cover) {
        switch (tree_[id].kind) {
        case NodeKind::type:
        case NodeKind::structure:
        case NodeKind::parameter:
        case NodeKind::label:
        case NodeKind::postfix: return; // constant, or its operand must stay as it is
        case NodeKind::prefix: return is_change(text_, id) ? void() : children(id, cover);
        case NodeKind::declaration: return declaration(id);
        case NodeKind::declarator: return declarator(id);
        case NodeKind::call: return call(id, cover);
        case NodeKind::binary: return binary(id, cover);
        case NodeKind::assign: return assign(id);
        case NodeKind::comma: return comma(id, cover);
        case NodeKind::jump: return jump(id);
        case NodeKind::loop_for:
        case NodeKind::loop_while:
        case NodeKind::loop_do: return loop(id);
        default: return children(id, cover);
        }
    }

    void declaration(NodeId id) {
        const NodeId type = tree_.child(id, 0);
        const bool constant = has_qualifier(text_, type, "const") || has_qualifier(text_, type, "uniform");
        const bool es_global = tree_[id].parent == 0 && text_.is_es();
        if (!constant && !es_global)
            children(id, Cover::open);
    }

    /// The value may be watched; brackets must stay constant.
    void declarator(NodeId id) {
        for (const NodeId part : tree_.children(id))
            if (!is_bracket(text_, part))
                visit(part, Cover::open);
    }

    bool wanted(NodeId id, Cover cover) const {
        if (contains(request_.repaired, id) || !is_float_operation(text_, facts_, id))
            return false;
        switch (request_.reach) {
        case WatchRequest::Reach::statements: return cover == Cover::open;
        case WatchRequest::Reach::operations: return tree_.is_within(id, request_.within);
        case WatchRequest::Reach::everything: return true;
        }
        return false;
    }

    Cover inside(NodeId id, Cover cover) const {
        return wanted(id, cover) ? Cover::covered : contains(request_.repaired, id) ? Cover::open : cover;
    }

    void lead(NodeId id, Cover cover) {
        if (wanted(id, cover))
            edits_.wrap(id, ours("P("), fmt::format(",{})", id));
        else if (contains(request_.repaired, id))
            edits_.wrap(id, ours("R("), ")");
    }

    void binary(NodeId id, Cover cover) {
        operand(id, tree_.child(id, 0), inside(id, cover));
        operand(id, tree_.child(id, 1), inside(id, cover));
        lead(id, cover);
    }

    /// Returns the buffer index where an operand of the captured node is recorded.
    std::optional<size_t> slot_of(NodeId operation, NodeId operand) const {
        const auto slot = std::ranges::find(result_.operands, operand);
        if (operation != request_.capture || slot == result_.operands.end())
            return std::nullopt;
        return WatchLayout::k_operands + size_t(slot - result_.operands.begin()) * WatchLayout::k_slot;
    }

    void operand(NodeId operation, NodeId id, Cover cover) {
        visit(id, cover);
        if (const auto slot = slot_of(operation, id))
            edits_.wrap(id, ours("C("), fmt::format(",{})", *slot));
    }

    void call(NodeId id, Cover cover) {
        const std::string_view name = called_name(text_, id);
        // Arguments of an author's function are watched before the call, because inside it they have no
        // statement.
        arguments(id, facts_.function(name) ? Cover::open : inside(id, cover));
        lead(id, cover);
        if (!std::ranges::binary_search(call_paths_.calls, id))
            return;
        if (facts_.functions.at(name).returns_nothing)
            edits_.wrap(id, fmt::format("({}push({}),", prefix_, id), fmt::format(",{}pop())", prefix_));
        else
            edits_.wrap(id, fmt::format("{0}K({0}push({1}),", prefix_, id), ")");
    }

    void arguments(NodeId id, Cover cover) {
        const NodeId callee = tree_.child(id, 0);
        const std::string_view name = called_name(text_, id);
        if (tree_[callee].kind == NodeKind::member) // .length()
            return;
        size_t index = 0;
        for (NodeId part = tree_[callee].next; part != k_no_node; part = tree_[part].next, ++index)
            if (name.empty() || !facts_.writes_argument(name, index))
                operand(id, part, cover);
    }

    /// Rewrites `target op= value` as `(target op= value, P(target))` if the target can be read once more.
    void assign(NodeId id) {
        const NodeId target = tree_.child(id, 0);
        const bool compound = is_float_operation(text_, facts_, id);
        const bool probed = compound && wanted(id, Cover::open);
        const bool mended = compound && contains(request_.repaired, id);
        operand(id, tree_.child(id, 1), probed ? Cover::covered : Cover::open);
        const std::string again = words_of(text_, target);
        if (mended) {
            edits_.wrap(id, "(", fmt::format(",{0}={1}R({0}))", again, prefix_));
        } else if (probed) {
            const auto slot = slot_of(id, target);
            edits_.wrap(id, slot ? fmt::format("({}C({},{}),", prefix_, again, *slot) : "(",
                        fmt::format(",{}P({},{}))", prefix_, again, id));
        }
    }

    /// Watches the first operand on its own: its value is dropped and reaches no other probe.
    void comma(NodeId id, Cover cover) {
        visit(tree_.child(id, 0), Cover::open);
        visit(tree_.child(id, 1), cover);
    }

    void jump(NodeId id) {
        if (text_.word_of(id) == "discard")
            edits_.wrap(id, "{" + flush(), "}");
    }

    void loop(NodeId id) {
        children(id, Cover::open);
        const NodeId body = tree_[id].kind == NodeKind::loop_do    ? tree_.child(id, 0)
                            : tree_[id].kind == NodeKind::loop_for ? tree_.child(id, 3)
                                                                   : tree_.child(id, 1);
        if (!request_.repaired.empty())
            edits_.wrap(body, fmt::format("{{if(++{}iterations>{})break;", prefix_, k_most_iterations), "}");
        const auto counted = std::ranges::find(result_.loops, id);
        if (counted == result_.loops.end())
            return;
        const auto index = counted - result_.loops.begin();
        edits_.wrap(body, fmt::format("{{if({0}h==0)++{0}L{1};", prefix_, index), "}");
        edits_.wrap(id, fmt::format("{{if({0}h==0){0}L{1}=0;", prefix_, index), "}");
    }

    /// Returns the operands that can be recorded: not literals, samplers or operands that are written to.
    std::vector<NodeId> operands_of(NodeId id) const {
        std::vector<NodeId> found;
        const auto add = [&](NodeId operand) {
            if (tree_[operand].kind == NodeKind::literal || found.size() == WatchLayout::k_most_operands)
                return;
            if (tree_[operand].kind == NodeKind::name) {
                const auto name = facts_.names.find(text_.word_of(operand));
                if (name != facts_.names.end() && (name->second.sampler || name->second.array))
                    return;
            }
            found.push_back(operand);
        };
        const std::string_view name = called_name(text_, id);
        if (tree_[id].kind == NodeKind::call && facts_.function(name))
            return found; // its arguments may be of any type
        NodeId part = tree_.child(id, 0);
        size_t index = 0;
        if (tree_[id].kind == NodeKind::call)
            part = tree_[part].next;
        for (; part != k_no_node; part = tree_[part].next, ++index) {
            const bool first_is_sampler = index == 0 && name.starts_with("texture");
            const bool texel = index == 0 && name.starts_with("texel");
            if (!first_is_sampler && !texel && !(!name.empty() && facts_.writes_argument(name, index)))
                add(part);
        }
        return found;
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    const WatchRequest& request_;
    std::string prefix_;
    PreludeOptions options_;
    CallPaths call_paths_;
    Watch result_;
    SourceRewriter edits_;
};

} // namespace

Watch watch(const ParsedText& text, const TreeFacts& facts, const WatchRequest& request) {
    return Watcher(text, facts, request).run();
}

namespace {

/// GLSL before the text; `@` is the number of expressions.
constexpr std::string_view k_seen_prelude = R"(uniform int $which;
vec4 $seen[@];
bool $met[@];
float $see(int i,float v){$seen[i]=vec4(v,0.0,0.0,0.0);$met[i]=true;return v;}
vec2 $see(int i,vec2 v){$seen[i]=vec4(v,0.0,0.0);$met[i]=true;return v;}
vec3 $see(int i,vec3 v){$seen[i]=vec4(v,0.0);$met[i]=true;return v;}
vec4 $see(int i,vec4 v){$seen[i]=v;$met[i]=true;return v;}
)";

/// GLSL at the end of `main`; `@` is its output.
constexpr std::string_view k_show = "@=$met[$which]?$seen[$which]:vec4(uintBitsToFloat(0x7fc00000u));}\n";

/// GLSL at the start of `main`; `@` is the number of expressions. Globals have no initial values.
constexpr std::string_view k_begin = "for(int $i=0;$i<@;++$i)$met[$i]=false;\n";

NodeId body_of_main(const ParsedText& text) {
    const SyntaxTree& tree = text.tree();
    for (const NodeId function : tree.children(0))
        if (tree[function].kind == NodeKind::function && text.word_of(function) == "main")
            for (const NodeId part : tree.children(function))
                if (tree[part].kind == NodeKind::block)
                    return part;
    return k_no_node;
}

} // namespace

SeenValues see_values(const ParsedText& text, std::span<const NodeId> expressions, std::string_view output) {
    const bool ours =
        std::ranges::any_of(text.words(), [&](const Word& word) { return word.text == output; });
    const NodeId body = body_of_main(text);
    if (!ours || body == k_no_node || expressions.empty())
        return {};
    const std::string prefix = fresh_prefix(text), count = fmt::format("{}", expressions.size());
    SourceRewriter edits(text);
    std::vector<size_t> order(expressions.size());
    for (size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::ranges::sort(order, {}, [&](size_t i) { return expressions[i]; }); // inner nodes first
    for (const size_t i : order)
        edits.wrap(expressions[i], fmt::format("{}see({},", prefix, i), ")");
    const Node& main = text.tree()[body];
    edits.replace(main.begin, "{" + spell(k_begin, prefix, count));
    edits.replace(main.end - 1, spell(k_show, prefix, output));
    return {headers_with_buffers(text) + spell(k_seen_prelude, prefix, count) + edits.text(),
            prefix + "which"};
}

} // namespace tidemark::glsl
