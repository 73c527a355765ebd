#include "shader/builtin_functions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace tidemark::glsl::builtin_functions_test {

std::string type_of(const std::string& name, const std::vector<std::string>& arguments) {
    std::vector<ValueType> types;
    for (const std::string& argument : arguments)
        types.push_back(*value_type(argument));
    const auto type = type_of_call(*find_builtin(name), types);
    return type ? to_string(*type) : "none";
}

TEST(BuiltinFunctions, each_function_has_one_row) {
    std::set<std::string_view> names;
    for (const BuiltinFunction& function : builtin_functions()) {
        EXPECT_TRUE(names.insert(function.name).second) << function.name;
        EXPECT_EQ(find_builtin(function.name), &function);
    }
    EXPECT_EQ(find_builtin("noise1"), nullptr);
    EXPECT_EQ(find_builtin("texture2D"), nullptr);
}

TEST(BuiltinFunctions, every_type_of_a_signature_exists) {
    for (const BuiltinFunction& function : builtin_functions()) {
        EXPECT_FALSE(overloads_of(function).empty()) << function.name;
        for (const BuiltinOverload& overload : overloads_of(function)) {
            EXPECT_TRUE(class_of_type(overload.result) != TypeClass::none || overload.result == "double")
                << function.name << " " << overload.result;
            EXPECT_FALSE(overload.parameters.empty()) << function.name;
            for (const BuiltinParameter& parameter : overload.parameters)
                EXPECT_TRUE(class_of_type(parameter.type) != TypeClass::none || parameter.type == "double" ||
                            parameter.type == "ivec2[4]")
                    << function.name << " " << parameter.type;
        }
    }
}

TEST(BuiltinFunctions, domains_refer_to_existing_arguments) {
    for (const BuiltinFunction& function : builtin_functions()) {
        if (!function.domain)
            continue;
        const std::string_view known = std::string_view("xyz").substr(0, most_parameters(function));
        EXPECT_NE(known.find(function.domain->argument), known.npos) << function.name;
        EXPECT_TRUE(function.domain->undefined[0].holds) << function.name;
        for (const UndefinedWhere& where : function.domain->undefined) {
            EXPECT_EQ(where.glsl.empty(), where.fault.empty()) << function.name;
            for (const char name : std::string_view("xyz"))
                EXPECT_TRUE(where.glsl.find(name) == where.glsl.npos || known.find(name) != known.npos)
                    << function.name << ": " << where.glsl;
        }
    }
}

/// A value that C++ cannot compute is undefined in GLSL too; for numbers that are not borders of the domain.
TEST(BuiltinFunctions, values_are_numbers_inside_of_the_domain) {
    for (const BuiltinFunction& function : builtin_functions())
        for (const double x : {-1.5, -0.5, 0.0, 0.5, 1.5})
            for (const double y : {-1.5, 0.0, 0.5}) {
                const bool undefined = function.domain && function.domain->broken({x, y, 0.5});
                EXPECT_TRUE(!function.value || undefined || std::isfinite(function.value({x, y, 0.5})))
                    << function.name << " of " << x << ", " << y;
            }
}

TEST(BuiltinFunctions, undefined_arguments_are_described) {
    const auto fault = [](const std::string& name, const Arguments& arguments) {
        const UndefinedWhere* const broken = find_builtin(name)->domain->broken(arguments);
        return broken ? std::string(broken->fault) : "";
    };
    EXPECT_EQ(fault("pow", {-1, 2}), "of a negative number");
    EXPECT_EQ(fault("pow", {0, 0}), "of 0 with an exponent that is not above 0");
    EXPECT_EQ(fault("pow", {0, 2}), "");
    EXPECT_EQ(fault("pow", {NAN, 2}), "");
    EXPECT_EQ(fault("log", {0}), "of a number that is not above 0");
    EXPECT_EQ(fault("acos", {-1}), "");
    EXPECT_EQ(fault("acos", {-1.1}), "outside of [-1, 1]");
    EXPECT_EQ(fault("atanh", {1}), "outside of (-1, 1)");
    EXPECT_EQ(fault("smoothstep", {1, 1, 2}), "with equal edges");
}

TEST(BuiltinFunctions, a_call_has_the_type_of_its_overload) {
    EXPECT_EQ(type_of("sin", {"vec3"}), "vec3");
    EXPECT_EQ(type_of("sin", {"int"}), "float");
    EXPECT_EQ(type_of("abs", {"ivec2"}), "ivec2");
    EXPECT_EQ(type_of("mod", {"vec2", "float"}), "vec2");
    EXPECT_EQ(type_of("mod", {"vec2", "vec3"}), "none");
    EXPECT_EQ(type_of("min", {"int", "int"}), "int");
    EXPECT_EQ(type_of("min", {"uint", "int"}), "uint");
    EXPECT_EQ(type_of("max", {"vec4", "int"}), "vec4");
    EXPECT_EQ(type_of("step", {"float", "vec2"}), "vec2");
    EXPECT_EQ(type_of("mix", {"vec3", "vec3", "bvec3"}), "vec3");
    EXPECT_EQ(type_of("dot", {"vec3", "vec3"}), "float");
    EXPECT_EQ(type_of("cross", {"vec3", "vec3"}), "vec3");
    EXPECT_EQ(type_of("transpose", {"mat2x3"}), "mat3x2");
    EXPECT_EQ(type_of("sin", {"mat2"}), "none");
    EXPECT_EQ(type_of("lessThan", {"vec3", "vec3"}), "bvec3");
}

TEST(BuiltinFunctions, written_arguments_are_listed) {
    for (const auto& [name, written] : {std::pair("modf", 0b10u),
                                        {"frexp", 0b10},
                                        {"uaddCarry", 0b100},
                                        {"usubBorrow", 0b100},
                                        {"umulExtended", 0b1100},
                                        {"imulExtended", 0b1100},
                                        {"sin", 0},
                                        {"texture", 0},
                                        {"author_s", 0}})
        EXPECT_EQ(builtin_written_arguments(name), written) << name;
}

TEST(BuiltinFunctions, optional_arguments_make_two_overloads) {
    EXPECT_EQ(overloads_of(*find_builtin("texture")).size(), 6u);
    EXPECT_TRUE(takes_constants(*find_builtin("textureGather")));
    EXPECT_FALSE(takes_constants(*find_builtin("texture")));
}

} // namespace tidemark::glsl::builtin_functions_test
