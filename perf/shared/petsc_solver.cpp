#ifdef ROCKFOLD_PETSC
#include "perf/shared/petsc_solver.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>

#include <petscksp.h>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

void check(PetscErrorCode code) {
  if (code != 0) std::abort();
}

using Gradients = std::array<Vec3, 4>;

/// Gradients of the linear weights of a tetrahedron of the lattice's cells.
Gradients gradients(const Lattice& lattice, const CellPart& part) {
  const Mat3 reciprocal = lattice.reciprocal();
  Gradients g{};
  for (int a = 0; a < 4; ++a)
    for (int d = 0; d < 3; ++d) g[a] += part.weight[a][1 << d] * reciprocal[d];
  return g;
}

void add_element(Mat matrix, const std::array<Index, 4>& cover, const Gradients& g, Real volume,
                 const ElasticMaterial& m) {
  const Real nu = m.poisson_ratio, mu = m.young_modulus / (2 * (1 + nu));
  const Real lambda = 2 * mu * nu / (1 - 2 * nu);
  std::array<PetscInt, 4> rows{};
  std::array<PetscScalar, 144> values{};
  for (int a = 0; a < 4; ++a) {
    rows[a] = cover[a];
    for (int b = 0; b < 4; ++b)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          values[12 * (3 * a + i) + 3 * b + j] =
              volume * (lambda * g[a][i] * g[b][j] + mu * g[b][i] * g[a][j] +
                        (i == j ? mu * dot(g[a], g[b]) : 0));
  }
  check(MatSetValuesBlocked(matrix, 4, rows.data(), 4, rows.data(), values.data(), ADD_VALUES));
}

/// Calls visit(covers, gradients, volume) for each tetrahedron of the rock.
template <class Visit>
void for_each_tetrahedron(const CoverArrays& covers, const PieceMoments& moments, Visit visit) {
  const Lattice& lattice = covers.lattice;
  const CellSplit& split = cell_split(lattice.kind);
  std::vector<Gradients> g;
  for (const CellPart& part : split.part) g.push_back(gradients(lattice, part));
  const Real whole = dot(lattice.edge[0], cross(lattice.edge[1], lattice.edge[2])) / 6;
  for (Index r = 0; r < covers.regular_count(); ++r)
    for (int t = 0; t < split.part_count(); ++t) {
      std::array<Index, 4> four{};
      for (int a = 0; a < 4; ++a) four[a] = covers.regular_cover[8 * r + split.part[t].node[a]];
      visit(four, g[t], whole);
    }
  for (Index e = 0; e < covers.cut_count(); ++e) {
    Real volume = 0;
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      volume += moments.volume[q];
    std::array<Index, 4> four{};
    for (int a = 0; a < 4; ++a) four[a] = covers.element_cover[4 * e + a];
    visit(four, g[covers.element_part[e]], volume);
  }
}

Vec to_petsc(const std::vector<Vec3>& x) {
  Vec v = nullptr;
  check(VecCreateSeq(PETSC_COMM_SELF, static_cast<PetscInt>(3 * x.size()), &v));
  check(VecSetBlockSize(v, 3));
  PetscScalar* values = nullptr;
  check(VecGetArray(v, &values));
  for (std::size_t i = 0; i < 3 * x.size(); ++i) values[i] = x[i / 3][i % 3];
  check(VecRestoreArray(v, &values));
  return v;
}

std::vector<Vec3> take(Vec v) {
  PetscInt n = 0;
  check(VecGetSize(v, &n));
  std::vector<Vec3> x(n / 3);
  const PetscScalar* values = nullptr;
  check(VecGetArrayRead(v, &values));
  for (PetscInt i = 0; i < n; ++i) x[i / 3][i % 3] = values[i];
  check(VecRestoreArrayRead(v, &values));
  check(VecDestroy(&v));
  return x;
}

}  // namespace

struct PetscMatrix::Data {
  Mat matrix = nullptr;
};

PetscMatrix::PetscMatrix(const CoverArrays& covers, const PieceMoments& moments,
                         const ElasticMaterial& material, const FixedPoints& fixed)
    : data_(new Data) {
  PetscBool ready = PETSC_FALSE;
  check(PetscInitialized(&ready));
  if (ready == PETSC_FALSE) check(PetscInitializeNoArguments());
  const PetscInt n = 3 * covers.cover_count();
  Mat& matrix = data_->matrix;
  check(MatCreate(PETSC_COMM_SELF, &matrix));
  check(MatSetSizes(matrix, n, n, n, n));
  check(MatSetType(matrix, MATSEQAIJ));
  check(MatSetBlockSize(matrix, 3));
  // Few rows have more neighbours than the lattice's 15; room for all of them costs a second assembly less.
  check(MatSeqAIJSetPreallocation(matrix, 3 * 24, nullptr));
  check(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  for_each_tetrahedron(covers, moments,
                       [&](const std::array<Index, 4>& four, const Gradients& g, Real volume) {
                         add_element(matrix, four, g, volume, material);
                       });
  for (std::size_t p = 0; p < fixed.points.size(); ++p)
    for (Index i = fixed.points.begin[p]; i < fixed.points.begin[p + 1]; ++i)
      for (Index j = fixed.points.begin[p]; j < fixed.points.begin[p + 1]; ++j)
        for (int d = 0; d < 3; ++d)
          if (fixed.component[p][d] != 0)
            check(MatSetValue(
                matrix, 3 * fixed.points.unknown[i] + d, 3 * fixed.points.unknown[j] + d,
                fixed.stiffness[p] * fixed.points.weight[i] * fixed.points.weight[j], ADD_VALUES));
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));

  std::vector<Vec3> nodes;
  for (Index node : covers.cover_node) nodes.push_back(covers.lattice.node_position(node));
  Vec places = to_petsc(nodes);
  MatNullSpace rigid = nullptr;
  check(MatNullSpaceCreateRigidBody(places, &rigid));
  check(MatSetNearNullSpace(matrix, rigid));
  check(MatNullSpaceDestroy(&rigid));
  check(VecDestroy(&places));
}

PetscMatrix::~PetscMatrix() {
  MatDestroy(&data_->matrix);
}

std::vector<Vec3> PetscMatrix::apply(const std::vector<Vec3>& x) const {
  Vec in = to_petsc(x), out = nullptr;
  check(VecDuplicate(in, &out));
  check(MatMult(data_->matrix, in, out));
  check(VecDestroy(&in));
  return take(out);
}

PetscResult PetscMatrix::solve(const std::string& preconditioner, double tolerance,
                               const std::vector<Vec3>& b, std::vector<Vec3>& x) const {
  Vec load = to_petsc(b), answer = nullptr;
  check(VecDuplicate(load, &answer));
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t ticks = std::clock();
  KSP solver = nullptr;
  check(KSPCreate(PETSC_COMM_SELF, &solver));
  check(KSPSetOperators(solver, data_->matrix, data_->matrix));
  check(KSPSetType(solver, KSPCG));
  check(KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED));
  check(KSPSetTolerances(solver, tolerance, 0, 1e30, 20000));
  PC pc = nullptr;
  check(KSPGetPC(solver, &pc));
  check(PCSetType(pc, preconditioner.c_str()));
  check(KSPSolve(solver, load, answer));
  PetscResult result;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.processor = double(std::clock() - ticks) / CLOCKS_PER_SEC;
  PetscInt iterations = 0;
  PetscReal residual = 0, norm = 0;
  check(KSPGetIterationNumber(solver, &iterations));
  check(KSPGetResidualNorm(solver, &residual));
  check(VecNorm(load, NORM_2, &norm));
  result.iterations = static_cast<int>(iterations);
  result.residual = residual / norm;
  check(KSPDestroy(&solver));
  check(VecDestroy(&load));
  x = take(answer);
  return result;
}

}  // namespace rockfold
#endif
