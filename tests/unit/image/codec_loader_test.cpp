#include "image/files/codec_loader.hpp"
#include "picture_support.hpp"

#include <sys/wait.h>

#include <cstdlib>

namespace tidemark::image {
namespace {

using CodecLoaderTest = PictureTest;

TEST(CodecLoader, finds_the_plug_in_of_this_build) {
    const Result<const PictureCodec*>& codec = picture_codec();
    ASSERT_TRUE(codec) << codec.error().message;
    EXPECT_EQ((*codec)->version, k_picture_codec_version);
    EXPECT_EQ(&picture_codec(), &codec);
}

TEST(CodecLoader, a_missing_plug_in_is_said_with_the_places_and_the_cure) {
    const auto missing = load_picture_codec("tidemark_nothing.so", {"/nowhere/bin", "/nowhere/lib/tidemark"});
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::load);
    EXPECT_EQ(missing.error().message,
              "reading and writing pictures needs the plug-in 'tidemark_nothing.so', which is not in "
              "'/nowhere/bin', '/nowhere/lib/tidemark', or where the system looks for libraries; reinstall "
              "Tidemark or put the plug-in beside the program");
}

TEST_F(CodecLoaderTest, a_file_that_is_no_library_is_an_error_with_the_loaders_reason) {
    const std::string plugin = put("tidemark_broken.so", "not a library").string();
    const auto broken = load_picture_codec("tidemark_broken.so", {folder()});
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().message, "cannot load the picture plug-in '" + plugin + "': " + plugin +
                                          ": file too short; install OpenImageIO 2.4 and the plug-in of this "
                                          "build of Tidemark");
}

TEST(CodecLoader, a_library_of_someone_elses_is_refused) {
    const auto foreign = load_picture_codec("libm.so.6", {});
    ASSERT_FALSE(foreign);
    EXPECT_EQ(foreign.error().message,
              "cannot load the picture plug-in 'libm.so.6': it is not Tidemark's; install "
              "OpenImageIO 2.4 and the plug-in of this build of Tidemark");
}

/// Runs in a process of its own, below: it leaves while the libraries are still being loaded.
TEST(CodecLoader, DISABLED_leaves_during_the_preload) {
    const std::jthread loading = preload_picture_codec("later.exr");
}

TEST_F(CodecLoaderTest, a_process_may_leave_during_the_preload) {
    const std::string log = in_folder("log").string();
    const std::string command =
        "exec " + fs::read_symlink("/proc/self/exe").string() +
        " --gtest_also_run_disabled_tests --gtest_filter=CodecLoader.DISABLED_leaves_during_the_preload >" +
        log + " 2>&1";
    for (int round = 0; round < 3; ++round) {
        const int status = std::system(command.c_str());
        EXPECT_TRUE(WIFEXITED(status));
        EXPECT_EQ(WEXITSTATUS(status), 0) << bytes_of(log);
    }
}

} // namespace
} // namespace tidemark::image
