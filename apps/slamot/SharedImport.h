#pragma once

#include "CarmenImport.h"
#include "MrclamImport.h"
#include "ScaledCarsImport.h"
#include "VictoriaParkImport.h"

namespace slamot::apps
{
/// What is asked for, by kind of import.
struct KindImports
{
  MrclamImport mrclam;
  VictoriaParkImport park;
  CarmenImport carmen;
  ScaledCarsImport cars;
};

/// Options that several kinds of import have, each kind with its own default.
class SharedImport
{
 public:
  /// What is asked for goes to all kinds that have the option.
  void addTo(CLI::App& command, KindImports& kinds);
  /// \throws core::Error (kConfig) on an option that was given, but is not of this kind.
  void check(const std::string& kind) const;

 private:
  using Kinds = std::vector<std::string>;
  void addNumber(CLI::App& command, const Kinds& kinds, const std::string& name,
                 const std::vector<double*>& values, const std::string& what, double factor = 1);
  void addSensor(CLI::App& command, KindImports& kinds);
  void addOdometry(CLI::App& command, KindImports& kinds);
  void addLaser(CLI::App& command, KindImports& kinds);

  std::vector<std::pair<const CLI::Option*, Kinds>> options_;
};
}  // namespace slamot::apps
