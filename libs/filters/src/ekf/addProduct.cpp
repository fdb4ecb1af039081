#include "addProduct.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

// Built with -ffp-contract=off: see the header.
namespace slamot::filters::ekf
{
namespace
{
using Index = Eigen::Index;

constexpr Index kRows = 8, kColumns = 4;  // of a tile, whose sums stay in registers
using Lanes = double __attribute__((vector_size(kRows * sizeof(double))));

/// Panels of so many rows, each with its entries in the order of use; zeros beyond the last row.
void pack(const ReadOnly& m, Index panel, std::vector<double>& out)
{
  const Index panels = (m.rows + panel - 1) / panel;
  out.resize(static_cast<std::size_t>(panels * panel * m.columns));
  for (Index p = 0; p < panels; ++p)
  {
    double* to = out.data() + p * panel * m.columns;
    const Index rows = std::min(panel, m.rows - p * panel);
    for (Index k = 0; k < m.columns; ++k, to += panel)
    {
      for (Index r = 0; r < rows; ++r) to[r] = m.data[(p * panel + r) * m.stepI + k * m.stepK];
      std::fill(to + rows, to + panel, 0.0);
    }
  }
}

struct Job
{
  double factor;
  const double *a, *b;  // packed
  Index depth, rows, columns;
  double* c;
  Index stride;
  bool lower;
};

inline __attribute__((always_inline)) void tile(const Job& job, Index i, Index j)
{
  const double* a = job.a + i * job.depth;
  const double* b = job.b + j * job.depth;
  Lanes sum0{}, sum1{}, sum2{}, sum3{};
  for (Index k = 0; k < job.depth; ++k, a += kRows, b += kColumns)
  {
    Lanes lanes;
    std::memcpy(&lanes, a, sizeof lanes);
    sum0 += lanes * b[0];
    sum1 += lanes * b[1];
    sum2 += lanes * b[2];
    sum3 += lanes * b[3];
  }
  const Lanes sums[kColumns] = {sum0 * job.factor, sum1 * job.factor, sum2 * job.factor,
                                sum3 * job.factor};
  const bool whole =
      i + kRows <= job.rows && j + kColumns <= job.columns && (!job.lower || i >= j + kColumns - 1);
  for (Index c = 0; c < std::min(kColumns, job.columns - j); ++c)
  {
    double* to = job.c + (j + c) * job.stride + i;
    if (whole)
    {
      Lanes old;
      std::memcpy(&old, to, sizeof old);
      old += sums[c];
      std::memcpy(to, &old, sizeof old);
      continue;
    }
    const Index first = job.lower ? std::max<Index>(0, j + c - i) : 0;
    for (Index r = first; r < std::min(kRows, job.rows - i); ++r) to[r] += sums[c][r];
  }
}

inline __attribute__((always_inline)) void allTiles(const Job& job)
{
  for (Index j = 0; j < job.columns; j += kColumns)
    for (Index i = job.lower ? j / kRows * kRows : 0; i < job.rows; i += kRows) tile(job, i, j);
}

void plainly(const Job& job)
{
  allTiles(job);
}
#ifdef __x86_64__
__attribute__((target("avx2"))) void byFours(const Job& job)
{
  allTiles(job);
}
__attribute__((target("avx512f"))) void byEights(const Job& job)
{
  allTiles(job);
}
#endif

struct Way
{
  const char* name;
  void (*run)(const Job&);
};

const std::vector<Way>& ways()
{
  static const std::vector<Way> list = []
  {
    std::vector<Way> out;
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx512f")) out.push_back({"avx512f", byEights});
    if (__builtin_cpu_supports("avx2")) out.push_back({"avx2", byFours});
#endif
    out.push_back({"plain", plainly});
    return out;
  }();
  return list;
}

void run(const Way& way, double factor, const ReadOnly& A, const ReadOnly& B, double* C,
         Index stride, bool lower)
{
  if (A.columns != B.columns) throw std::invalid_argument("addProduct: sizes do not agree");
  thread_local std::vector<double> a, b;  // room that stays, since most products are small
  pack(A, kRows, a);
  pack(B, kColumns, b);
  way.run({factor, a.data(), b.data(), A.columns, A.rows, B.rows, C, stride, lower});
}
}  // namespace

void addProduct(double factor, const ReadOnly& A, const ReadOnly& B, double* C, Index stride,
                bool lower)
{
  run(ways().front(), factor, A, B, C, stride, lower);
}

std::vector<std::string> productWays()
{
  std::vector<std::string> out;
  for (const Way& way : ways()) out.emplace_back(way.name);
  return out;
}

void addProduct(const std::string& way, double factor, const ReadOnly& A, const ReadOnly& B,
                double* C, Index stride, bool lower)
{
  for (const Way& w : ways())
    if (w.name == way) return run(w, factor, A, B, C, stride, lower);
  throw std::invalid_argument("addProduct: this processor has no " + way);
}
}  // namespace slamot::filters::ekf
