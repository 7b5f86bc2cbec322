#pragma once

namespace yade {

/// A class that dispatchers choose functors by: each class of a family has its own number.
class Indexable {
protected:
	void createIndex()
	{
		int& index = modifyClassIndex();
		if (index >= 0) return;
		index = getMaxCurrentlyUsedClassIndexOfKin() + 1;
		incrementMaxCurrentlyUsedClassIndexOfKin();
	}
	virtual void incrementMaxCurrentlyUsedClassIndexOfKin();
	virtual int& modifyClassIndex();

public:
	Indexable() = default;
	virtual ~Indexable();
	virtual const int& getClassIndex() const;
	virtual const int& getBaseClassIndex(int depth) const;
	virtual const int& getMaxCurrentlyUsedClassIndexOfKin() const;
};

} // namespace yade

/// For a plugin class; its constructor calls createIndex().
#define REGISTER_CLASS_INDEX(Class, Base)                                                                                                                      \
private:                                                                                                                                                       \
	static int& modifyClassIndexStatic()                                                                                                                   \
	{                                                                                                                                                      \
		static int index = -1;                                                                                                                         \
		return index;                                                                                                                                  \
	}                                                                                                                                                      \
                                                                                                                                                               \
protected:                                                                                                                                                     \
	int& modifyClassIndex() override { return modifyClassIndexStatic(); }                                                                                  \
                                                                                                                                                               \
public:                                                                                                                                                        \
	static const int& getClassIndexStatic() { return modifyClassIndexStatic(); }                                                                           \
	const int&        getClassIndex() const override { return getClassIndexStatic(); }                                                                     \
	const int&        getBaseClassIndex(int depth) const override { return depth == 1 ? Base::getClassIndex() : Base::getBaseClassIndex(depth - 1); }

/// For a class in YADE's libraries: root of a family, in the order of its vtable.
#define YADE_API_INDEXED_ROOT                                                                                                                                  \
protected:                                                                                                                                                     \
	int& modifyClassIndex() override;                                                                                                                      \
                                                                                                                                                               \
public:                                                                                                                                                        \
	const int& getClassIndex() const override;                                                                                                             \
	const int& getBaseClassIndex(int depth) const override;                                                                                                \
	const int& getMaxCurrentlyUsedClassIndexOfKin() const override;                                                                                        \
                                                                                                                                                               \
protected:                                                                                                                                                     \
	void incrementMaxCurrentlyUsedClassIndexOfKin() override;                                                                                              \
                                                                                                                                                               \
public:

/// For a class in YADE's libraries: member of a family.
#define YADE_API_INDEXED                                                                                                                                       \
protected:                                                                                                                                                     \
	int& modifyClassIndex() override;                                                                                                                      \
                                                                                                                                                               \
public:                                                                                                                                                        \
	const int& getClassIndex() const override;                                                                                                             \
	const int& getBaseClassIndex(int depth) const override;
