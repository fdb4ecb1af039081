#include <slamot/fusion/Radio.h>
#include <slamot/math/random.h>

#include <algorithm>
#include <tuple>

namespace slamot::fusion
{
Radio::Options Radio::Options::from(core::Params& p, std::uint64_t seed)
{
  return {p.inRange("message_loss", 0, 1, 0.0), p.nonNegative("message_delay_s", 0.0),
          p.nonNegative("message_delay_spread_s", 0.0), p.inRange("message_duplication", 0, 1, 0.0),
          seed};
}

void Radio::send(int from, int to, double now, const Bytes& bytes)
{
  const std::uint64_t number = sent_[{from, to}]++;
  math::RandomStream random{options_.seed, 0x726164696fu, static_cast<std::uint64_t>(from),
                            static_cast<std::uint64_t>(to), number};
  if (random.uniform() < options_.loss) return;
  const int copies = random.uniform() < options_.duplication ? 2 : 1;
  for (int i = 0; i < copies; ++i)
  {
    const double arrival = now + options_.delay + options_.delaySpread * random.uniform();
    flights_[to].push_back({arrival, from, number, bytes});
  }
}

std::vector<Bytes> Radio::receive(int to, double now)
{
  auto& flights = flights_[to];
  std::stable_sort(
      flights.begin(), flights.end(),
      [](const Flight& a, const Flight& b)
      { return std::tie(a.arrival, a.from, a.number) < std::tie(b.arrival, b.from, b.number); });
  const auto end = std::find_if(flights.begin(), flights.end(),
                                [&](const Flight& f) { return f.arrival > now; });
  std::vector<Bytes> out;
  for (auto it = flights.begin(); it != end; ++it) out.push_back(std::move(it->bytes));
  flights.erase(flights.begin(), end);
  return out;
}
}  // namespace slamot::fusion
