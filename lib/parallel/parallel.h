// Work on several threads: oneTBB's algorithms, with what its hand-over of work guarantees told to the thread sanitizer.
//
// What was written before work is handed over can be read where it is done, and what was written there, by who waits for it.
// libtbb brings that about by atomics, of which the sanitizer knows nothing, since Debian's is not built for it. Two pieces of
// work have no order by this: a race between them is seen.
#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/task_group.h>

#include <utility>

#ifdef __has_feature
#if __has_feature(thread_sanitizer)
#define SGTOOLS_THREAD_SANITIZER
extern "C" void __tsan_acquire(void* at);
extern "C" void __tsan_release(void* at);
#endif
#endif

namespace sg::parallel {

// What a thread wrote before it released a place is known to who acquires that place afterwards.
#ifdef SGTOOLS_THREAD_SANITIZER
inline void release(char& place) {
  __tsan_release(&place);
}
inline void acquire(char& place) {
  __tsan_acquire(&place);
}
#else
inline void release(char& /*place*/) {}
inline void acquire(char& /*place*/) {}
#endif

// From who calls to those that work, and back.
struct HandOver {
  char given = 0, back = 0;
};

// A piece of work, taken and done.
template <class Work>
void take(HandOver& hand_over, const Work& work) {
  acquire(hand_over.given);
  work();
  release(hand_over.back);
}

// Calls work(k) for 0 .. count - 1.
template <class Number, class Work>
void each(Number count, const Work& work) {
  HandOver hand_over;
  release(hand_over.given);
  tbb::parallel_for(Number{0}, count, [&](Number k) { take(hand_over, [&] { work(k); }); });
  acquire(hand_over.back);
}

// Calls work(first, last) for parts of 0 .. count, each of at most about `grain`.
template <class Number, class Work>
void each_part(Number count, Number grain, const Work& work) {
  using Range = tbb::blocked_range<Number>;
  HandOver hand_over;
  release(hand_over.given);
  tbb::parallel_for(Range(0, count, grain), [&](const Range& part) {
    take(hand_over, [&] { work(part.begin(), part.end()); });
  });
  acquire(hand_over.back);
}

template <class First, class Second>
void both(const First& first, const Second& second) {
  HandOver hand_over;
  release(hand_over.given);
  tbb::parallel_invoke([&] { take(hand_over, first); }, [&] { take(hand_over, second); });
  acquire(hand_over.back);
}

// Pieces of work that are begun one by one.
class Tasks {
 public:
  template <class Work>
  void begin(Work work) {
    release(hand_over_.given);
    group_.run([this, work = std::move(work)] { take(hand_over_, work); });
  }
  void wait() {
    group_.wait();
    acquire(hand_over_.back);
  }

 private:
  tbb::task_group group_;
  HandOver hand_over_;
};

}  // namespace sg::parallel
