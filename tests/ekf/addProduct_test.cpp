#include "ekf/addProduct.h"

#include "dense.h"

namespace slamot::filters::ekf
{
namespace
{
/// One entry after another, sums in rising order.
void entryByEntry(double factor, const ReadOnly& A, const ReadOnly& B, Eigen::MatrixXd& C,
                  bool lower)
{
  for (Eigen::Index j = 0; j < C.cols(); ++j)
    for (Eigen::Index i = lower ? j : 0; i < C.rows(); ++i)
    {
      volatile double sum = 0;  // lest the compiler contract or reorder
      for (Eigen::Index k = 0; k < A.columns; ++k)
      {
        volatile const double product =
            A.data[i * A.stepI + k * A.stepK] * B.data[j * B.stepI + k * B.stepK];
        sum = sum + product;
      }
      volatile const double scaled = sum * factor;
      C(i, j) += scaled;
    }
}
}  // namespace

TEST(AddProduct, GivesTheSameBitsInEveryWay)
{
  math::RandomStream random{5};
  for (const int rows : {1, 7, 8, 9, 41})
    for (const int columns : {1, 3, 4, 6, 29})
      for (const int depth : {0, 1, 2, 42})
        for (const bool transposed : {false, true})
        {
          const Eigen::MatrixXd a =
              transposed ? randomMatrix(depth, rows, random) : randomMatrix(rows, depth, random);
          const Eigen::MatrixXd b = transposed ? randomMatrix(depth, columns, random)
                                               : randomMatrix(columns, depth, random);
          const Eigen::MatrixXd c = randomMatrix(rows, columns, random);
          const ReadOnly A = transposed ? ReadOnly::transposeOf(a) : ReadOnly::of(a);
          const ReadOnly B = transposed ? ReadOnly::transposeOf(b) : ReadOnly::of(b);
          for (const bool lower : {false, true})
          {
            Eigen::MatrixXd expected = c;
            entryByEntry(-0.7, A, B, expected, lower);
            for (const std::string& way : productWays())
            {
              Eigen::MatrixXd C = c;
              addProduct(way, -0.7, A, B, C.data(), C.outerStride(), lower);
              EXPECT_TRUE(C == expected) << way << ' ' << rows << 'x' << columns << 'x' << depth;
            }
          }
        }
}

TEST(AddProduct, LeavesWhatLiesOutside)
{
  math::RandomStream random{6};
  const Eigen::MatrixXd a = randomMatrix(5, 3, random);
  for (const std::string& way : productWays())
  {
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(12, 9);
    addProduct(way, 1, ReadOnly::of(a), ReadOnly::of(a), C.data(), C.outerStride(), true);
    EXPECT_EQ(C.bottomRows(7).cwiseAbs().maxCoeff(), 0) << way;
    EXPECT_EQ(C.rightCols(4).cwiseAbs().maxCoeff(), 0) << way;
    EXPECT_NE(C(4, 4), 0) << way;
  }
  EXPECT_THROW(addProduct("none", 1, ReadOnly::of(a), ReadOnly::of(a), nullptr, 0, true),
               std::invalid_argument);
}
}  // namespace slamot::filters::ekf
