#include "ir/spirv.hpp"

#include "base/plug_in.hpp"
#include "base/try.hpp"

namespace tidemark::ir {
namespace {

const Result<const SpirvCompiler*>& spirv_compiler() {
    static const Result<const SpirvCompiler*> compiler = [] {
        const PlugIn plug_in{"tidemark_spirv.so", "SPIR-V plug-in",       "proving something of a scene",
                             "glslang 12",        k_spirv_compiler_entry, k_spirv_compiler_version};
        return load_plug_in<SpirvCompiler>(plug_in);
    }();
    return compiler;
}

} // namespace

Result<Function> compile(const std::string& text, Names names) {
    const SpirvCompiler* compiler = TRY(spirv_compiler());
    const SpirvResult words = compiler->compile(text, names);
    if (!words)
        return fail(ErrorCode::load, words.error());
    return read_spirv(*words);
}

} // namespace tidemark::ir
