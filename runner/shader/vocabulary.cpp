#include "shader/vocabulary.hpp"

#include "base/encoding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>

namespace tidemark::glsl {
namespace {

int digit(char c) {
    return c >= '2' && c <= '4' ? c - '0' : 0;
}

} // namespace

std::optional<ValueType> value_type(std::string_view name) {
    if (name == "float" || name == "int" || name == "uint" || name == "bool")
        return ValueType{name[0], 1, 1};
    const bool prefixed = name.starts_with("ivec") || name.starts_with("uvec") || name.starts_with("bvec");
    const char base = prefixed ? name[0] : 'f';
    if (prefixed)
        name.remove_prefix(1);
    if (name.starts_with("vec") && name.size() == 4 && digit(name[3]) > 0)
        return ValueType{base, 1, digit(name[3])};
    if (prefixed || !name.starts_with("mat"))
        return std::nullopt;
    name.remove_prefix(3);
    if (name.size() == 1 && digit(name[0]) > 0)
        return ValueType{'f', digit(name[0]), digit(name[0])};
    if (name.size() == 3 && name[1] == 'x' && digit(name[0]) > 0 && digit(name[2]) > 0)
        return ValueType{'f', digit(name[0]), digit(name[2])};
    return std::nullopt;
}

std::string to_string(const ValueType& type) {
    if (type.matrix() && type.columns == type.rows)
        return fmt::format("mat{}", type.rows);
    if (type.matrix())
        return fmt::format("mat{}x{}", type.columns, type.rows);
    const std::string_view scalar = type.base == 'f'   ? "float"
                                    : type.base == 'i' ? "int"
                                    : type.base == 'u' ? "uint"
                                                       : "bool";
    if (type.scalar())
        return std::string(scalar);
    return type.base == 'f' ? fmt::format("vec{}", type.rows) : fmt::format("{}vec{}", type.base, type.rows);
}

std::optional<ValueType> type_of_literal(std::string_view digits) {
    const bool hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
    const bool floating = !hexadecimal && digits.find_first_of(".eEfF") != std::string_view::npos;
    const bool is_unsigned = digits.ends_with('u') || digits.ends_with('U');
    if (digits.ends_with("lf") || digits.ends_with("LF"))
        return std::nullopt;
    return ValueType{floating ? 'f' : is_unsigned ? 'u' : 'i', 1, 1};
}

std::optional<ValueType> type_of_operation(std::string_view op, const ValueType& left,
                                           const ValueType& right) {
    if (op != "+" && op != "-" && op != "*" && op != "/")
        return std::nullopt;
    const bool mixed = left.base != right.base;
    if (left.base == 'b' || right.base == 'b' || (mixed && left.base != 'f' && right.base != 'f'))
        return std::nullopt;
    const char base = mixed ? 'f' : left.base;
    const auto as = [base](ValueType type) {
        type.base = base;
        return type;
    };
    if (left.scalar())
        return as(right);
    if (right.scalar())
        return as(left);
    if (op != "*" || (left.vector() && right.vector()))
        return left.columns == right.columns && left.rows == right.rows ? std::optional(as(left))
                                                                        : std::nullopt;
    if (left.vector()) // a row vector
        return left.rows == right.rows ? std::optional(ValueType{base, 1, right.columns}) : std::nullopt;
    if (left.columns != right.rows)
        return std::nullopt;
    return ValueType{base, right.columns, left.rows};
}

std::optional<ValueType> type_of_member(const ValueType& vector, std::string_view member) {
    if (!vector.vector() || member.empty() || member.size() > 4)
        return std::nullopt;
    for (const std::string_view names : {"xyzw", "rgba", "stpq"})
        if (std::all_of(member.begin(), member.end(), [&](char c) {
                return names.substr(0, size_t(vector.rows)).find(c) != std::string_view::npos;
            }))
            return ValueType{vector.base, 1, int(member.size())};
    return std::nullopt;
}

TypeClass class_of_type(std::string_view word) {
    if (const auto type = value_type(word))
        return type->base == 'f' ? TypeClass::floating : TypeClass::whole;
    if (word.starts_with("sampler") || word.starts_with("isampler") || word.starts_with("usampler"))
        return TypeClass::sampler;
    return word == "void" ? TypeClass::nothing : TypeClass::none;
}

std::string double_type_of(std::string_view type) {
    return type == "float" ? "double" : is_float_type(type) ? fmt::format("d{}", type) : std::string(type);
}

std::string_view float_type_of(std::string_view double_type) {
    if (double_type == "double")
        return "float";
    return double_type.starts_with('d') && is_float_type(double_type.substr(1)) ? double_type.substr(1)
                                                                                : std::string_view{};
}

std::optional<long> whole_number(std::string_view digits) {
    int base = 10;
    if (digits.starts_with("0x") || digits.starts_with("0X")) {
        base = 16;
        digits.remove_prefix(2);
    } else if (digits.size() > 1 && digits[0] == '0') {
        base = 8;
    }
    long number = 0;
    const char* const end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, number, base);
    return read.ec == std::errc{} && read.ptr == end ? std::optional(number) : std::nullopt;
}

std::optional<double> number(std::string_view word) {
    if (word.starts_with("0x") || word.starts_with("0X"))
        return std::nullopt;
    while (!word.empty() && std::string_view("uUfF").find(word.back()) != std::string_view::npos)
        word.remove_suffix(1);
    return number_from<double>(word);
}

namespace {

struct Lookalike {
    int code;
    std::string_view glsl;
};

constexpr Lookalike k_lookalikes[] = {
    {0x00b7, "*"},  {0x00d7, "*"},  {0x00f7, "/"}, {0x2010, "-"}, {0x2011, "-"}, {0x2013, "-"},
    {0x2014, "-"},  {0x2044, "/"},  {0x2212, "-"}, {0x2215, "/"}, {0x2217, "*"}, {0x2260, "!="},
    {0x2264, "<="}, {0x2265, ">="}, {0xff08, "("}, {0xff09, ")"}, {0xff0b, "+"}, {0xff0c, ","},
    {0xff0d, "-"},  {0xff0e, "."},  {0xff1b, ";"}, {0xff1d, "="}, {0xff5b, "{"}, {0xff5d, "}"}};

/// Returns whether the character is a space of another width, a mark for writing direction or the byte-order
/// mark.
bool is_blank(int code) {
    return code == 0x85 || code == 0xa0 || code == 0xad || code == 0x1680 ||
           (code >= 0x2000 && code <= 0x200f) || (code >= 0x2028 && code <= 0x202f) ||
           (code >= 0x205f && code <= 0x2064) || code == 0x3000 || code == 0xfeff;
}

} // namespace

std::optional<StrangeCharacter> strange_character(std::string_view text) {
    const auto first = static_cast<unsigned char>(text.empty() ? 0 : text.front());
    if (first < 0x80 || continues_character(text.front()))
        return std::nullopt;
    const auto [length, code] = first_character(text);
    if (code < 0)
        return StrangeCharacter{fmt::format("a byte that is not UTF-8 (0x{:02x})", first), false, {}};
    const auto alike = std::ranges::find(k_lookalikes, code, &Lookalike::code);
    const std::string shown = is_blank(code) ? "a blank" : fmt::format("'{}'", text.substr(0, length));
    return StrangeCharacter{fmt::format("{} (U+{:04X})", shown, code), is_blank(code),
                            alike == std::end(k_lookalikes) ? std::string_view() : alike->glsl};
}

std::string advice_on(const StrangeCharacter& character) {
    return character.instead.empty() ? "names have letters a to z and A to Z, digits and _"
                                     : fmt::format("write {}", character.instead);
}

} // namespace tidemark::glsl
