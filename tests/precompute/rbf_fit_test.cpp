// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "synthesis/rbf_fit.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "support/rbf_reference.h"
#include "vsprite/random.h"

namespace vsprite {
namespace {

// A smooth map of the places to three numbers.
void take_values(Examples& e) {
  e.y.clear();
  for (int i = 0; i < e.count(); ++i) {
    const double* x = &e.x[static_cast<std::size_t>(i * e.dims)];
    double sum = 0;
    for (int d = 0; d < e.dims; ++d) sum += x[d] * (d + 1);
    e.y.insert(e.y.end(), {100 * std::sin(sum), 50 * x[0] * x[0] - sum, std::cos(3 * x[0])});
  }
}

Examples smooth_examples(int dims, int count) {
  Random random{1};
  Examples out{.dims = dims, .outputs = 3, .x = {}, .y = {}};
  for (int i = 0; i < count * dims; ++i) out.x.push_back(random.unit());
  take_values(out);
  return out;
}

// At places that keep apart: multiples of numbers far from any fraction.
Examples spread_examples(int dims, int count) {
  const double steps[] = {0.6180339887, 0.7548776662, 0.8191725134};
  Examples out{.dims = dims, .outputs = 3, .x = {}, .y = {}};
  for (int i = 0; i < count; ++i)
    for (int d = 0; d < dims; ++d) out.x.push_back(std::fmod(0.5 + i * steps[d], 1.0));
  take_values(out);
  return out;
}

std::vector<double> value(const RbfNetwork& net, std::vector<double> x) {
  std::vector<double> out(static_cast<std::size_t>(net.outputs));
  predict(net, x, out);
  return out;
}

void expect_equal_to_reference(const Examples& e, const RbfConfig& config, const char* what) {
  const auto net = fit_rbf(e, config);
  ASSERT_TRUE(net) << what << net.error().message;
  ASSERT_LT(reference::condition(e, config), 1e6) << what << " degree " << config.degree;
  Random random{99};
  for (int k = 0; k < 20; ++k) {
    std::vector<double> x;
    for (int d = 0; d < e.dims; ++d) x.push_back(random.unit());
    const auto due = reference::interpolate(e, config, x.data());
    const auto found = value(*net, x);
    for (std::size_t m = 0; m < found.size(); ++m)
      EXPECT_NEAR(found[m], static_cast<double>(due[m]),
                  1e-9 * std::max(1.0, std::abs(static_cast<double>(due[m]))))
          << what << " output " << m;
  }
}

TEST(RbfFit, EqualsTheDenseReferenceForEveryKernelAndDegree) {
  for (int dims = 1; dims <= 3; ++dims) {
    const Examples e = spread_examples(dims, dims == 1 ? 6 : 14);
    for (int k = 0; k < kKernelCount; ++k)
      for (int degree = -1; degree <= 1; ++degree) {
        const RbfConfig config{.kernel = static_cast<Kernel>(k),
                               .degree = degree,
                               .allow_low_degree = true,
                               .width = k == 1 || k == 3 ? 0.1 : 0.3};
        expect_equal_to_reference(e, config, kernel_name(config.kernel).data());
      }
  }
}

// Where digits are lost whatever one does, f still goes through the examples.
TEST(RbfFit, KeepsTheResidualOfIllConditionedSystems) {
  for (int dims = 1; dims <= 3; ++dims) {
    const int count = dims == 1 ? 8 : 20;
    Examples e = spread_examples(dims, count);
    for (int k = 0; k < kKernelCount; ++k) {
      const double apart = k == 0 ? 1e-6 : 3e-5;  // two examples lie close together
      for (int d = 0; d < dims; ++d)
        e.x[static_cast<std::size_t>((count - 1) * dims + d)] =
            e.x[static_cast<std::size_t>((count - 2) * dims + d)] + apart * (d + 1);
      take_values(e);
      for (int degree = -1; degree <= 1; ++degree) {
        const RbfConfig config{.kernel = static_cast<Kernel>(k),
                               .degree = degree,
                               .allow_low_degree = true,
                               .width = 0.15};
        ASSERT_GT(reference::condition(e, config), 1e6) << k;
        const auto net = fit_rbf(e, config);
        ASSERT_TRUE(net) << net.error().message;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
          const auto at = e.x.begin() + static_cast<std::ptrdiff_t>(i) * dims;
          const auto found = value(*net, {at, at + dims});
          for (std::size_t m = 0; m < 3; ++m)
            EXPECT_NEAR(found[m], e.y[3 * i + m], 1e-9 * 100)  // the examples reach to 100
                << kernel_name(config.kernel) << " degree " << degree << " in " << dims;
        }
      }
    }
  }
}

TEST(RbfFit, EqualsTheReferenceWithRidgeMetricAndCycles) {
  const Examples e = spread_examples(2, 12);
  for (int k = 0; k < kKernelCount; ++k)
    for (int degree = -1; degree <= 1; ++degree) {
      RbfConfig config{.kernel = static_cast<Kernel>(k),
                       .degree = degree,
                       .allow_low_degree = true,
                       .width = 0.2,
                       .ridge = 0.05};
      config.metric = {1.5, 0.3, -0.2, 0.8};
      expect_equal_to_reference(e, config, "ridge, metric");
      config.period = {1.25, 0};
      expect_equal_to_reference(e, config, "ridge, metric, cyclic");
      config.metric.clear(), config.ridge = 0;
      expect_equal_to_reference(e, config, "cyclic");
      config.period = {1.25, 2};
      expect_equal_to_reference(e, config, "cyclic in both");
    }
}

// tests/golden/rbf_scipy.txt is written by tests/golden/rbf_scipy.py: scipy's RBFInterpolator.
TEST(RbfFit, EqualsScipy) {
  std::ifstream file(VSPRITE_SOURCE_DIR "/tests/golden/rbf_scipy.txt");
  std::string line;
  int cases = 0;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream head(line);
    int kernel = 0, n = 0, places = 0;
    RbfConfig config;
    Examples e{.dims = 0, .outputs = 0, .x = {}, .y = {}};
    head >> kernel >> config.degree >> config.width >> config.ridge >> e.dims >> e.outputs >> n >>
        places;
    config.kernel = static_cast<Kernel>(kernel), config.allow_low_degree = true;
    const auto read = [&](int count) {
      std::vector<double> out(static_cast<std::size_t>(count));
      for (double& v : out) file >> v;
      return out;
    };
    e.x = read(n * e.dims), e.y = read(n * e.outputs);
    const auto at = read(places * e.dims), due = read(places * e.outputs);
    std::getline(file, line);
    const auto net = fit_rbf(e, config);
    ASSERT_TRUE(net) << net.error().message;
    for (int p = 0; p < places; ++p) {
      const auto from = at.begin() + p * e.dims;
      const auto found = value(*net, {from, from + e.dims});
      for (std::size_t m = 0; m < found.size(); ++m) {
        const double d = due[static_cast<std::size_t>(p * e.outputs) + m];
        EXPECT_NEAR(found[m], d, 1e-9 * std::max(1.0, std::abs(d)))
            << kernel << " degree " << config.degree;
      }
    }
    ++cases;
  }
  EXPECT_EQ(cases, 22);
}

TEST(RbfFit, IsExactAtTheExamplesAndKeepsTheSideConditions) {
  const Examples e = smooth_examples(2, 30);
  for (int k = 0; k < kKernelCount; ++k) {
    const auto net = fit_rbf(e, {.kernel = static_cast<Kernel>(k), .width = 0.25});
    ASSERT_TRUE(net);
    for (std::size_t i = 0; i < 30; ++i) {
      const auto found = value(*net, {e.x[2 * i], e.x[2 * i + 1]});
      for (std::size_t m = 0; m < 3; ++m) EXPECT_NEAR(found[m], e.y[3 * i + m], 1e-7);
    }
    double sum = 0, moment = 0, size = 0;
    for (std::size_t i = 0; i < 30; ++i)
      sum += net->weights[3 * i], moment += net->weights[3 * i] * e.x[2 * i],
          size += std::abs(net->weights[3 * i]);
    EXPECT_NEAR(sum / size, 0, 1e-12);
    EXPECT_NEAR(moment / size, 0, 1e-12);
  }
}

TEST(RbfFit, LeaveOneOutInClosedFormIsTheReferenceFittedAnew) {
  const Examples e = spread_examples(2, 12);
  for (int k = 0; k < kKernelCount; ++k)
    for (int degree = -1; degree <= 1; ++degree)
      for (const bool cyclic : {false, true}) {
        RbfConfig config{.kernel = static_cast<Kernel>(k),
                         .degree = degree,
                         .allow_low_degree = true,
                         .width = 0.2,
                         .ridge = degree == 0 ? 1e-3 : 0};
        if (cyclic) config.period = {1.25, 0};
        ASSERT_LT(reference::condition(e, config), 1e6) << k << " degree " << degree;
        const auto errors = leave_one_out(e, config);
        ASSERT_TRUE(errors);
        for (std::size_t i = 0; i < 12; ++i) {
          Examples rest = e;
          const auto at = static_cast<std::ptrdiff_t>(i);
          rest.x.erase(rest.x.begin() + 2 * at, rest.x.begin() + 2 * at + 2);
          rest.y.erase(rest.y.begin() + 3 * at, rest.y.begin() + 3 * at + 3);
          const auto left = reference::interpolate(rest, config, &e.x[2 * i]);
          for (std::size_t m = 0; m < 3; ++m) {
            const double due = e.y[3 * i + m] - static_cast<double>(left[m]);
            EXPECT_NEAR((*errors)[3 * i + m], due, 1e-9 * std::max(1.0, std::abs(due)))
                << kernel_name(config.kernel) << " degree " << degree << " example " << i;
          }
        }
      }
}

TEST(RbfFit, RefusesKernelsBelowTheirDegreeUnlessAskedByName) {
  const Examples e = smooth_examples(2, 8);
  for (const auto& [kernel, degree] : {std::pair{Kernel::ThinPlate, 0},
                                       {Kernel::ThinPlate, -1},
                                       {Kernel::Linear, -1},
                                       {Kernel::Multiquadric, -1}}) {
    const auto net = fit_rbf(e, {.kernel = kernel, .degree = degree});
    ASSERT_FALSE(net);
    EXPECT_EQ(net.error().code, ErrorCode::BadSetting);
    EXPECT_NE(net.error().message.find(kernel_name(kernel)), std::string::npos);
    EXPECT_TRUE(fit_rbf(e, {.kernel = kernel, .degree = degree, .allow_low_degree = true}));
  }
  EXPECT_FALSE(fit_rbf(e, {.kernel = Kernel::ThinPlate, .period = {1, 0}}));
}

TEST(RbfFit, NamesWhatIsWrongWithTheExamples) {
  Examples e = smooth_examples(2, 6);
  e.x[6] = e.x[2], e.x[7] = e.x[3];
  EXPECT_NE(fit_rbf(e).error().message.find("examples 2 and 4"), std::string::npos);
  e = smooth_examples(2, 6);
  e.y[4] = std::nan("");
  EXPECT_NE(fit_rbf(e).error().message.find("example 2"), std::string::npos);
  EXPECT_EQ(fit_rbf(smooth_examples(2, 2)).error().code, ErrorCode::BadContent);
  EXPECT_EQ(fit_rbf({.dims = 2, .outputs = 3, .x = {}, .y = {}}).error().code,
            ErrorCode::BadContent);
}

// Two examples, a linear kernel, no polynomial [Darrell 1998]: Phi = [[0, d], [d, 0]] is exact and
// goes straight between them; the angle's way round is the short one.
TEST(RbfFit, IsDarrellsLinearNetworkOnAngles) {
  const double turn = 2 * std::acos(-1.0);
  const Examples e{.dims = 1, .outputs = 1, .x = {0.1, turn - 0.3}, .y = {10, 20}};
  const auto net = fit_rbf(e, {.kernel = Kernel::Linear,
                               .degree = -1,
                               .allow_low_degree = true,
                               .pseudo_inverse = true,
                               .period = {turn}});
  ASSERT_TRUE(net);
  EXPECT_NEAR(value(*net, {0.1})[0], 10, 1e-9);
  EXPECT_NEAR(value(*net, {-0.3})[0], 20, 1e-9);
  EXPECT_NEAR(value(*net, {turn - 0.1})[0], 15, 1e-9);
}

TEST(HyperBf, DescendsAndWandersBelowItsFirstError) {
  const Examples e = smooth_examples(2, 40);
  for (const HyperTraining training : {HyperTraining::Gradient, HyperTraining::RandomSearch}) {
    const auto fit = fit_hyperbf(e, {.rbf = {.kernel = Kernel::Gaussian, .degree = 0, .width = 0.5},
                                     .centers = 5,
                                     .training = training});
    ASSERT_TRUE(fit);
    EXPECT_LT(fit->error, 0.5 * fit->first_error);
    EXPECT_EQ(fit->net.center_count(), 5);
    double sum = 0;
    for (std::size_t i = 0; i < 40; ++i) {
      const auto found = value(fit->net, {e.x[2 * i], e.x[2 * i + 1]});
      for (std::size_t m = 0; m < 3; ++m) sum += std::pow(found[m] - e.y[3 * i + m], 2);
    }
    EXPECT_NEAR(sum, fit->error, 1e-6 * fit->first_error);
  }
}

// y depends on the first parameter alone: the learned norm stretches it and shrinks the other.
TEST(HyperBf, LearnsWhichParameterMatters) {
  Examples e = smooth_examples(2, 40);
  for (std::size_t i = 0; i < 40; ++i)
    for (std::size_t m = 0; m < 3; ++m) e.y[3 * i + m] = std::sin(4 * e.x[2 * i]);
  const auto fit = fit_hyperbf(e, {.rbf = {.kernel = Kernel::Gaussian, .degree = 0, .width = 0.5},
                                   .centers = 4,
                                   .training = HyperTraining::RandomSearch,
                                   .steps = 2000});
  ASSERT_TRUE(fit);
  const auto& w = fit->net.metric;
  EXPECT_GT(std::hypot(w[0], w[2]), 5 * std::hypot(w[1], w[3]));
}

TEST(HyperBf, GivesTheSameBytesForTheSameSeed) {
  const Examples e = smooth_examples(2, 20);
  const HyperConfig config{.rbf = {.kernel = Kernel::Gaussian, .degree = 0, .width = 0.5},
                           .training = HyperTraining::RandomSearch,
                           .seed = 7};
  EXPECT_EQ(fit_hyperbf(e, config)->net.weights, fit_hyperbf(e, config)->net.weights);
  HyperConfig other = config;
  other.seed = 8;
  EXPECT_NE(fit_hyperbf(e, config)->net.weights, fit_hyperbf(e, other)->net.weights);
}

}  // namespace
}  // namespace vsprite
