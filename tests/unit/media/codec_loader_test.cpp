#include "media/picture_codecs.hpp"
#include "picture_support.hpp"

#include <sys/wait.h>

#include <cstdlib>

namespace tidemark::image::codec_loader_test {

using CodecLoaderTest = PictureTest;

TEST(CodecLoader, finds_the_plug_in_of_this_build) {
    const Result<const PictureCodec*>& codec = picture_codec();
    ASSERT_TRUE(codec) << codec.error().message;
    EXPECT_EQ((*codec)->version, k_picture_codec_version);
    EXPECT_EQ(&picture_codec(), &codec);
}

/// Runs in a process of its own, below: it leaves while the libraries are still being loaded.
TEST(CodecLoader, DISABLED_exits_during_the_preload) {
    const std::jthread loading = preload_picture_codec("later.exr");
}

TEST_F(CodecLoaderTest, a_process_may_exit_during_the_preload) {
    const std::string log = in_folder("log").string();
    const std::string command =
        "exec " + fs::read_symlink("/proc/self/exe").string() +
        " --gtest_also_run_disabled_tests --gtest_filter=CodecLoader.DISABLED_exits_during_the_preload >" +
        log + " 2>&1";
    for (int round = 0; round < 3; ++round) {
        const int status = std::system(command.c_str());
        EXPECT_TRUE(WIFEXITED(status));
        EXPECT_EQ(WEXITSTATUS(status), 0) << bytes_of(log);
    }
}

} // namespace tidemark::image::codec_loader_test
