// The places that tests/mutants/run broke, all compiled at once: place k is as written unless SGTOOLS_MUTANT=k. Each file
// with such a place begins by including this.
//
// `a < b` becomes `a < sgm::lt{k} < b`: the tag takes `a`, then `b`, at the operator's own precedence, so that no operand
// has to be found in the text.
#pragma once

#include <type_traits>
#include <utility>

namespace sgm {

extern int active;              // SGTOOLS_MUTANT; 0: none
extern unsigned char* reached;  // by site, kept in the file SGTOOLS_MUTANT_REACHED

[[gnu::always_inline]] inline bool on(int k) {
  reached[k] = 1;
  return active == k;
}
[[gnu::always_inline]] inline bool flip(int k, bool condition) {
  return on(k) != condition;
}
template <class T>
[[gnu::always_inline]] inline T constant(int k, T number) {
  return on(k) ? static_cast<T>(number + 1) : number;
}
template <class T>
[[gnu::always_inline]] inline T least(int k, const T& a, const T& b) {
  return (b < a) != on(k) ? b : a;
}
template <class T>
[[gnu::always_inline]] inline T most(int k, const T& a, const T& b) {
  return (a < b) != on(k) ? b : a;
}

// One of two results. Matrix expressions are evaluated: their types differ, and they point at temporaries.
template <class Plain, class Mutated>
[[gnu::always_inline]] inline auto choose(int k, const Plain& plain, const Mutated& mutated) {
  if constexpr (requires { plain().eval(); }) {
    using Result = std::remove_cvref_t<decltype(plain().eval())>;
    if (on(k)) return Result(mutated());
    return Result(plain());
  } else {
    using Result = std::remove_cvref_t<decltype(plain())>;
    if (on(k)) return static_cast<Result>(mutated());
    return static_cast<Result>(plain());
  }
}
template <class T>
[[gnu::always_inline]] inline auto negative(int k, T&& number) {
  return choose(
      k, [&] { return +number; }, [&] { return -number; });
}
template <class T>
requires requires(const T& t) {
  t.eval();
}
[[gnu::always_inline]] inline auto negative(int k, const T& matrix) {
  using Result = std::remove_cvref_t<decltype(matrix.eval())>;
  return on(k) ? Result(-matrix) : Result(matrix);
}

#define SGM_OPERATOR(name, op, mutated_op, result)                                  \
  struct name {                                                                     \
    int k;                                                                          \
  };                                                                                \
  template <class A>                                                                \
  struct name##_left {                                                              \
    A&& a;                                                                          \
    int k;                                                                          \
  };                                                                                \
  template <class A>                                                                \
  [[gnu::always_inline]] inline name##_left<A> operator op(A&& a, name tag) {       \
    return {static_cast<A&&>(a), tag.k};                                            \
  }                                                                                 \
  template <class A, class B>                                                       \
  [[gnu::always_inline]] inline result operator op(name##_left<A> left, B&& b) {    \
    return choose(                                                                  \
        left.k, [&]() -> decltype(auto) { return static_cast<A&&>(left.a) op b; },  \
        [&]() -> decltype(auto) { return static_cast<A&&>(left.a) mutated_op b; }); \
  }
SGM_OPERATOR(lt, <, <=, bool)
SGM_OPERATOR(le, <=, <, bool)
SGM_OPERATOR(gt, >, >=, bool)
SGM_OPERATOR(ge, >=, >, bool)
SGM_OPERATOR(eq, ==, !=, bool)
SGM_OPERATOR(ne, !=, ==, bool)
SGM_OPERATOR(plus, +, -, auto)
SGM_OPERATOR(minus, -, +, auto)
SGM_OPERATOR(times, *, /, auto)
SGM_OPERATOR(over, /, *, auto)
SGM_OPERATOR(modulo, %, /, auto)
#undef SGM_OPERATOR

}  // namespace sgm
