#include "proof/plugin/spirv_compiler.hpp"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <spirv-tools/optimizer.hpp>

#include <exception>
#include <mutex>

namespace tidemark::proof {
namespace {

/// Larger modules take too long: the passes below take more than linear time.
constexpr size_t k_most_words = 400'000;

tl::expected<std::vector<uint32_t>, std::string> front_end(const std::string& text, Names names) {
    static std::once_flag initialised;
    std::call_once(initialised, [] { glslang::InitializeProcess(); });
    glslang::TShader shader(EShLangFragment);
    const char* strings[] = {text.c_str()};
    shader.setStrings(strings, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangFragment, glslang::EShClientOpenGL, 100);
    shader.setEnvClient(glslang::EShClientOpenGL, glslang::EShTargetOpenGL_450);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_0);
    shader.setAutoMapLocations(true);
    shader.setAutoMapBindings(true);
    if (!shader.parse(GetDefaultResources(), 450, false, EShMsgSpvRules))
        return tl::unexpected(std::string(shader.getInfoLog()));
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(EShMsgSpvRules) || !program.mapIO())
        return tl::unexpected(std::string(program.getInfoLog()));
    glslang::SpvOptions options;
    options.generateDebugInfo = true; // lines
    options.emitNonSemanticShaderDebugInfo = names == Names::keep;
    options.disableOptimizer = true;
    std::vector<uint32_t> words;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangFragment), words, &options);
    return words;
}

/// Registers passes that inline everything into one function and convert its variables to SSA form; nothing
/// is reordered or contracted. Without names, repeated computations are merged, so intervals see that they
/// are equal; with names, each is kept under its own name.
void register_passes(spvtools::Optimizer& optimizer, Names names) {
    using namespace spvtools;
    const auto ssa = [&optimizer] {
        optimizer.RegisterPass(CreateScalarReplacementPass(0))
            .RegisterPass(CreateLocalAccessChainConvertPass())
            .RegisterPass(CreateLocalSingleBlockLoadStoreElimPass())
            .RegisterPass(CreateLocalSingleStoreElimPass())
            .RegisterPass(CreateSSARewritePass())
            .RegisterPass(CreateAggressiveDCEPass());
    };
    optimizer.RegisterPass(CreateDeadBranchElimPass())
        .RegisterPass(CreateMergeReturnPass())
        .RegisterPass(CreateInlineExhaustivePass())
        .RegisterPass(CreateEliminateDeadFunctionsPass())
        .RegisterPass(CreatePrivateToLocalPass());
    ssa();
    ssa();
    if (names == Names::drop)
        optimizer.RegisterPass(CreateRedundancyEliminationPass());
    optimizer.RegisterPass(CreateDeadBranchElimPass())
        .RegisterPass(CreateAggressiveDCEPass())
        .RegisterPass(CreateCFGCleanupPass());
}

SpirvResult compile_or_throw(const std::string& text, Names names) {
    auto words = front_end(text, names);
    if (!words)
        return words;
    if (words->size() > k_most_words)
        return tl::unexpected(std::string("it is too large"));
    spvtools::Optimizer optimizer(SPV_ENV_OPENGL_4_5);
    std::string log;
    optimizer.SetMessageConsumer([&log](spv_message_level_t, const char*, const spv_position_t&,
                                        const char* message) { log += std::string(message) + "\n"; });
    register_passes(optimizer, names);
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    std::vector<uint32_t> inlined;
    if (!optimizer.Run(words->data(), words->size(), &inlined, options))
        return tl::unexpected(log);
    return inlined;
}

SpirvResult compile(const std::string& text, Names names) noexcept {
    try {
        return compile_or_throw(text, names);
    } catch (const std::exception& error) {
        return tl::unexpected(std::string(error.what()));
    }
}

const SpirvCompiler k_compiler{k_spirv_compiler_version, compile};

} // namespace
} // namespace tidemark::proof

extern "C" __attribute__((visibility("default"))) const void* tidemark_spirv_compiler() {
    return &tidemark::proof::k_compiler;
}
