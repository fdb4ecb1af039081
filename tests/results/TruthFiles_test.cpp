#include "TemporaryFolder.h"

#include <slamot/core/Error.h>
#include <slamot/results/TruthFiles.h>

namespace slamot::results
{
namespace
{
using test::TemporaryFolder;

eval::Truth someTruth()
{
  eval::Truth truth;
  truth.robot.poses = {{0, {1, 2, 3}, true}, {0.5, {1.5, 2, 3}, true}};
  truth.targets[7].poses = {{0.5, {4, 5, 0}, false}};
  truth.landmarks = {{0, {1.125, -2}}, {12, {3, 4}}};
  truth.associations = {{0.5, 0, 12}, {0.5, 2, -1}, {1, 0, 0}};
  truth.relations = {{1, 0.5, {1.25, -3, 3}}, {1, 1.5, {0, 0, -0.5}}};
  return truth;
}

TEST(TruthFiles, FolderIsNamedAfterTheLog)
{
  EXPECT_EQ(truthFolder("a/b.c/X.rawlog"), "a/b.c/X.truth");
  EXPECT_EQ(truthFolder("a/b.c/X"), "a/b.c/X.truth");
  EXPECT_EQ(truthFolder("X.robot0.rawlog"), "X.robot0.truth");
}

TEST(TruthFiles, ComeBackAsTheyWereWritten)
{
  const TemporaryFolder folder;
  const eval::Truth a = someTruth();
  saveTruth(folder.file("X.truth"), a);
  const eval::Truth b = loadTruth(folder.file("X.truth"));
  EXPECT_EQ(b.robot.poses.size(), 2u);
  ASSERT_EQ(b.targets.count(7), 1u);
  EXPECT_FALSE(b.targets.at(7).poses.at(0).headingKnown);
  ASSERT_EQ(b.landmarks.size(), 2u);
  EXPECT_EQ(b.landmarks.at(0).x, 1.125);
  EXPECT_EQ(b.landmarks.at(12).y, 4);
  ASSERT_EQ(b.associations.size(), 3u);
  EXPECT_EQ(b.associations[1].index, 2);
  EXPECT_EQ(b.associations[1].id, -1);
  ASSERT_EQ(b.relations.size(), 2u);
  EXPECT_EQ(b.relations[0].to, 0.5);
  EXPECT_EQ(b.relations[0].pose_from_to, Pose2D(1.25, -3, 3));
}

TEST(TruthFiles, SavingAgainLeavesNothingOfTheOldTruthAndAllThatIsNotTruth)
{
  const TemporaryFolder folder;
  saveTruth(folder.file("X.truth"), someTruth());
  folder.write("X.truth/notes.txt", "mine");
  eval::Truth other;
  other.robot.poses = {{0, {}, true}};
  saveTruth(folder.file("X.truth"), other);
  const eval::Truth b = loadTruth(folder.file("X.truth"));
  EXPECT_EQ(b.robot.poses.size(), 1u);
  EXPECT_TRUE(b.targets.empty());
  EXPECT_TRUE(b.landmarks.empty());
  EXPECT_TRUE(b.associations.empty());
  EXPECT_TRUE(b.relations.empty());
  EXPECT_EQ(folder.read("X.truth/notes.txt"), "mine");
}

TEST(TruthFiles, NoFolderIsNoTruth)
{
  const TemporaryFolder folder;
  const eval::Truth truth = loadTruth(folder.file("none.truth"));
  EXPECT_TRUE(truth.robot.empty() && truth.targets.empty() && truth.landmarks.empty());
}

TEST(TruthFiles, NameTheLineOfWhatIsWrong)
{
  const auto expect = [](const std::string& name, const std::string& text, const std::string& part)
  {
    const TemporaryFolder folder;
    folder.write("X.truth/" + name, text);
    try
    {
      (void)loadTruth(folder.file("X.truth"));
      ADD_FAILURE() << text;
    }
    catch (const core::Error& e)
    {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  };
  expect("landmarks.csv", "id;x;y\n", "landmarks.csv line 1: the header is not 'id,x,y'");
  expect("landmarks.csv", "", "landmarks.csv line 1: the file ends");
  expect("landmarks.csv", "id,x,y\n1,2\n", "line 2: has 2 columns, not 3");
  expect("landmarks.csv", "id,x,y\n1.5,2,3\n", "line 2: id '1.5' is no whole number");
  expect("landmarks.csv", "id,x,y\n-1,2,3\n", "line 2: a landmark's id is negative");
  expect("landmarks.csv", "id,x,y\n1,2,3\n\n1,2,3\n", "line 4: landmark 1 comes twice");
  expect("landmarks.csv", "id,x,y\n1,,3\n", "line 2: x '' is no finite number");
  expect("associations.csv", "t,index,id\n1,0,3\n1,0,4\n", "line 3: is not after");
  expect("associations.csv", "t,index,id\n1,0,-2\n", "line 2: a negative index, or an id below -1");
  expect("relations.csv", "t1,t2\n", "relations.csv line 1: the header is not");
  expect("relations.csv", "t1,t2,dx,dy,dtheta\n1,2,0,nan,0\n", "line 2: dy 'nan' is no finite");
  expect("target_3.tum", "1 2 3\n", "target_3.tum line 1: has 3 fields");
}
}  // namespace
}  // namespace slamot::results
