#include "../results/TemporaryFolder.h"
#include "program.h"

#include <slamot/mrpt/Scene.h>

#include <filesystem>

namespace slamot
{
namespace
{
using test::slamot;
using test::TemporaryFolder;

mrpt::SceneData sampleScene()
{
  mrpt::SceneData data;
  data.title = "a";
  data.robot.name = "robot";
  data.robot.path = {{{0, 0}, {1, 2}}};
  return data;
}

TEST(SlamotRender, DrawsTheSceneOfAResult)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("result"));
  mrpt::saveScene(folder.file("result/scene.3Dscene"), sampleScene());
  const auto outcome = slamot("render result -o a.png --width 320 --height 200", folder.file(""));
  if (outcome.text.find("OpenGL") != std::string::npos) GTEST_SKIP() << outcome.text;
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_EQ(folder.read("a.png").substr(1, 3), "PNG");
}

TEST(SlamotRender, NamesWhatIsWrong)
{
  const TemporaryFolder folder;
  mrpt::saveScene(folder.file("a.3Dscene"), sampleScene());
  const auto video = slamot("render a.3Dscene -o a.xyz", folder.file(""));
  EXPECT_EQ(video.status, 1);
  EXPECT_EQ(
      video.text,
      "slamot: error: command line --output a.xyz: is the name of neither a picture nor a video; "
      "end it in .png or .mp4\n");
  const auto absent = slamot("render nothing -o a.png", folder.file(""));
  EXPECT_EQ(absent.status, 2);
  EXPECT_EQ(absent.text,
            "slamot: error: nothing: is not a scene that can be read; give a result folder or a "
            ".3Dscene file\n");
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.png")));
}
}  // namespace
}  // namespace slamot
