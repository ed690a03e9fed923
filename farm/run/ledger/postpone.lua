-- Turns an owner's claim into one that anyone may take over, and takes back the count of its start.
--
-- KEYS[1]  claims: sorted set of job ids; the score is when the claim lapses, in seconds of the Unix epoch
-- KEYS[2]  owners: hash from job id to the owner of its claim
-- KEYS[3]  starts: hash from job id to the number of its starts
-- ARGV[1]  job id
-- ARGV[2]  owner that holds the claim
-- ARGV[3]  seconds until the claim lapses
-- ARGV[4]  owner's name of a job that waits for its next attempt
-- ARGV[5]  seconds for which the keys are kept after this write
-- Returns  1; 0 if the claim is not the owner's, and then nothing changes

if redis.call('HGET', KEYS[2], ARGV[1]) ~= ARGV[2] then
    return 0
end

local time = redis.call('TIME')
local now = time[1] + time[2] / 1e6
redis.call('ZADD', KEYS[1], string.format('%.6f', now + ARGV[3]), ARGV[1])
redis.call('HSET', KEYS[2], ARGV[1], ARGV[4])
for _, key in ipairs(KEYS) do
    redis.call('EXPIRE', key, ARGV[5])
end
redis.call('HINCRBY', KEYS[3], ARGV[1], -1)
return 1
